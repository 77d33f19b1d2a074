#include <pfaff/runs/outcome.hpp>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

std::string place_of(const Quad& t, std::int64_t step) {
  return "at t = " + to_string(t, 10) + " (step " + std::to_string(step) + ")";
}

std::string failure(Status status, const std::string& where) {
  switch (status) {
    case Status::not_converged:
      return "the step did not converge " + where;
    case Status::singular:
      return "a linear system was singular " + where;
    case Status::non_finite:
      return "the state or the structure left the range of numbers " + where;
    case Status::converged:
      break;
  }
  return {};
}

std::string Outcome::message() const {
  switch (end_) {
    case End::failed:
      // What a method that chooses its steps calls so is that none is small enough: it may be an explicit
      // one.
      if (chosen_ && status_ == Status::not_converged)
        return "the step control gave up " + where_ + ": no step meets the tolerance";
      return failure(status_, where_);
    case End::watcher:
      return "a watcher ended the integration " + where_;
    case End::asked:
      return "the integration was interrupted " + where_;
    case End::reached:
      break;
  }
  return {};
}

void Outcome::expect_reached() const {
  if (!reached()) throw RunError(message());
}

}  // namespace pfaff
