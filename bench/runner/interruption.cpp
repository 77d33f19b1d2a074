#include <pfaff/bench/runner/interruption.hpp>

namespace pfaff {

namespace {
std::atomic<bool> asked_to_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

// Signals that are ignored, as those of programs in the background may be, stay ignored.
void set_handler(int signal, struct sigaction& before) {
  struct sigaction action {};
  action.sa_handler = [](int /*signal*/) { asked_to_stop.store(true); };
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
}
}  // namespace

Interruption::Interruption() : budget_({}, &asked_to_stop) {
  asked_to_stop.store(false);
  set_handler(SIGINT, interrupt_before_);
  set_handler(SIGTERM, terminate_before_);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
}

const std::atomic<bool>& Interruption::stop() { return asked_to_stop; }

void end_interrupted(const BudgetSpent& spent, const std::string& done) {
  if (!spent.stopped()) throw BudgetSpent(spent);
  throw RunError("interrupted: " + done);
}

}  // namespace pfaff
