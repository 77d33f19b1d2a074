#include <pfaff/bench/runner/interruption.hpp>

namespace pfaff {

namespace {
std::atomic<bool> asked_to_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

// Signals that are ignored, as those of programs in the background may be, stay ignored.
void set_handler(int number, struct sigaction& before) {
  struct sigaction action {};
  action.sa_handler = [](int signal) {
    if (!asked_to_stop.exchange(true) || signal == SIGHUP)
      return;                      // of which a terminal that closes may send two
    std::signal(signal, SIG_DFL);  // a second one, whichever it is, comes as soon as this has returned
    raise(signal);
  };
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(number, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
}
}  // namespace

Interruption::Interruption() : budget_({}, &asked_to_stop) {
  asked_to_stop.store(false);
  for (std::size_t k = 0; k < signals.size(); ++k) set_handler(signals[k], before_[k]);
}

Interruption::~Interruption() {
  for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before_[k], nullptr);
}

const std::atomic<bool>& Interruption::stop() { return asked_to_stop; }

void end_interrupted(const BudgetSpent& spent, const std::string& done) {
  if (!spent.stopped()) throw BudgetSpent(spent);
  throw RunError("interrupted: " + done);
}

}  // namespace pfaff
