// The processes that make the runs of an experiment: this one alone, on all its cores, or several that a
// launcher has started, on one machine or on many that see the same files.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace pfaff {

class Team {
 public:
  Team() = default;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  virtual ~Team() = default;

  /// True in the one process that takes the directory, puts the results together and talks to the user.
  [[nodiscard]] virtual bool leads() const = 0;
  [[nodiscard]] virtual bool several() const = 0;
  /// Calls `ask` in the leading process and returns its answer in all of them.
  virtual std::vector<std::size_t> agreed(const std::function<std::vector<std::size_t>()>& ask) = 0;
  /// Hands out 0 ... count - 1, each to whoever is free. make(k), false where it did not get to its end, may
  /// be called by several threads; done(k) follows in the leading process for each that did, one at a time.
  /// What make() throws is thrown in the leading process.
  virtual void share(std::size_t count, const std::function<bool(std::size_t)>& make,
                     const std::function<void(std::size_t)>& done) = 0;
};

/// The team that a launcher of MPI has started, of which this process is one; null where none has. The
/// processes of a team that do not lead are silent from then on. InputError where Pfaff was built without
/// MPI.
std::unique_ptr<Team> launched_team();

/// This process alone.
class ThisProcess final : public Team {
 public:
  [[nodiscard]] bool leads() const override { return true; }
  [[nodiscard]] bool several() const override { return false; }
  std::vector<std::size_t> agreed(const std::function<std::vector<std::size_t>()>& ask) override {
    return ask();
  }
  void share(std::size_t count, const std::function<bool(std::size_t)>& make,
             const std::function<void(std::size_t)>& done) override;
};

}  // namespace pfaff
