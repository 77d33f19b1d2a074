// A team of the ranks that mpirun has started; built with -DPFAFF_MPI=ON in the place of none.cpp.
//
// Rank 0 leads. It hands out runs, one at a time, to whoever asks, and makes runs in a thread of its own
// meanwhile. All ranks must see the same files: what a run leaves is written by the rank that made it, as a
// single process would. Messages are two numbers, or the text of an error; ranks that wait look for them now
// and then and sleep in between, because a blocking call of MPI would keep a core busy.
#include <mpi.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include <pfaff/bench/experiment/team.hpp>
#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace {
constexpr int report_tag = 1, answer_tag = 2, error_tag = 3;
constexpr std::int64_t over = -1;
enum Ending : std::int64_t { nothing, finished, unfinished, failed, gone };

void wait(MPI_Request& request) {
  for (int done = 0; done == 0;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}
// The number that rank 0 has, in all ranks.
std::int64_t broadcast(std::int64_t number) {
  MPI_Request request{};
  MPI_Ibcast(&number, 1, MPI_INT64_T, 0, MPI_COMM_WORLD, &request);
  wait(request);
  return number;
}
std::vector<std::int64_t> broadcast(std::vector<std::int64_t> list, std::int64_t size) {
  list.resize(static_cast<std::size_t>(size));
  MPI_Request request{};
  MPI_Ibcast(list.data(), static_cast<int>(size), MPI_INT64_T, 0, MPI_COMM_WORLD, &request);
  wait(request);
  return list;
}

class Ranks final : public Team {
 public:
  Ranks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    // One process talks to the user: the others have the same to say.
    if (!leads())
      for (FILE* stream : {stdout, stderr})
        if (std::freopen("/dev/null", "w", stream) == nullptr) std::exit(1);
  }
  // Whatever ends this process, by return or by exception, the others are told or heard to their end.
  ~Ranks() override {
    if (leads()) {
      if (!over_) (void)broadcast(over);
    } else {
      while (!over_) {
        const std::int64_t size = broadcast(0);
        over_ = size == over;
        if (over_ || size == 0) continue;
        (void)broadcast({}, size);
        send({nothing, gone}, "");
      }
    }
    MPI_Finalize();
    // Launchers kill all processes once one has ended with another status than 0. What is to be said of an
    // error, in words and by the status, the leading process says, which must come to it.
    if (!leads() && std::uncaught_exceptions() > 0) std::_Exit(EXIT_SUCCESS);
  }

  [[nodiscard]] bool leads() const override { return rank_ == 0; }
  [[nodiscard]] bool several() const override { return size_ > 1; }

  std::vector<std::size_t> agreed(const std::function<std::vector<std::size_t>()>& ask) override {
    std::vector<std::size_t> answer;
    if (leads()) try {
        answer = ask();
      } catch (...) {
        over_ = true;
        (void)broadcast(over);
        throw;
      }
    const std::int64_t size = broadcast(static_cast<std::int64_t>(answer.size()));
    over_ = size == over;
    if (over_) throw RunError("the leading process has ended");
    if (size == 0) return answer;
    const auto list = broadcast(std::vector<std::int64_t>(answer.begin(), answer.end()), size);
    answer.clear();
    for (const std::int64_t k : list) answer.push_back(static_cast<std::size_t>(k));
    return answer;
  }

  void share(std::size_t count, const std::function<bool(std::size_t)>& make,
             const std::function<void(std::size_t)>& done) override {
    if (count == 0) return;
    if (leads()) {
      hand_out(count, make, done);
    } else {
      work(make);
    }
  }

 private:
  using Report = std::array<std::int64_t, 2>;  // which, and how it ended

  static void send(const Report& report, const std::string& error) {
    MPI_Send(report.data(), 2, MPI_INT64_T, 0, report_tag, MPI_COMM_WORLD);
    if (report[1] == failed)
      MPI_Send(error.data(), static_cast<int>(error.size()), MPI_CHAR, 0, error_tag, MPI_COMM_WORLD);
  }

  static void work(const std::function<bool(std::size_t)>& make) {
    Report report{0, nothing};
    std::string error;
    for (;;) {
      send(report, error);
      std::int64_t which = over;
      MPI_Request request{};
      MPI_Irecv(&which, 1, MPI_INT64_T, 0, answer_tag, MPI_COMM_WORLD, &request);
      wait(request);
      if (which == over) return;
      report[0] = which;
      try {
        report[1] = make(static_cast<std::size_t>(which)) ? finished : unfinished;
      } catch (const std::exception& thrown) {
        report[1] = failed;
        error = thrown.what();
      }
    }
  }

  void hand_out(std::size_t count, const std::function<bool(std::size_t)>& make,
                const std::function<void(std::size_t)>& done) const {
    std::mutex mutex;
    std::size_t next = 0;
    std::vector<std::size_t> made;  // by this process, and not yet reported
    bool busy = true;
    std::exception_ptr thrown;
    const auto take = [&](std::size_t& k) {
      const std::lock_guard lock(mutex);
      k = next;
      if (next < count) ++next;
      return k < count;
    };
    const auto stop = [&](const std::exception_ptr& why) {
      const std::lock_guard lock(mutex);
      next = count;
      if (thrown == nullptr) thrown = why;
    };
    std::thread own([&] {
      try {
        for (std::size_t k = 0; take(k);)
          if (make(k)) {
            const std::lock_guard lock(mutex);
            made.push_back(k);
          }
      } catch (...) {
        stop(std::current_exception());
      }
      const std::lock_guard lock(mutex);
      busy = false;
    });
    for (int others = size_ - 1;;) {
      int arrived = 0;
      MPI_Status status{};
      if (others > 0) MPI_Iprobe(MPI_ANY_SOURCE, report_tag, MPI_COMM_WORLD, &arrived, &status);
      if (arrived != 0) {
        const auto [which, ending] = received(status.MPI_SOURCE);
        if (ending == finished) done(static_cast<std::size_t>(which));
        if (ending == failed) stop(std::make_exception_ptr(RunError(text_from(status.MPI_SOURCE))));
        std::size_t k = 0;
        const std::int64_t answer = ending != gone && take(k) ? static_cast<std::int64_t>(k) : over;
        if (ending != gone) MPI_Send(&answer, 1, MPI_INT64_T, status.MPI_SOURCE, answer_tag, MPI_COMM_WORLD);
        if (answer == over) --others;
        continue;
      }
      bool still = false;
      std::vector<std::size_t> mine;
      {
        const std::lock_guard lock(mutex);
        mine.swap(made);
        still = busy;
      }
      for (const std::size_t k : mine) done(k);
      if (!still && others == 0) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    own.join();
    if (thrown != nullptr) std::rethrow_exception(thrown);
  }

  static Report received(int source) {
    Report report{};
    MPI_Recv(report.data(), 2, MPI_INT64_T, source, report_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return report;
  }
  static std::string text_from(int source) {
    MPI_Status status{};
    MPI_Probe(source, error_tag, MPI_COMM_WORLD, &status);
    int size = 0;
    MPI_Get_count(&status, MPI_CHAR, &size);
    std::string text(static_cast<std::size_t>(size), ' ');
    MPI_Recv(text.data(), size, MPI_CHAR, source, error_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return text;
  }

  int rank_ = 0, size_ = 1;
  bool over_ = false;  // the leading process has said so, or has been heard to
};
}  // namespace

std::unique_ptr<Team> launched_team() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (std::getenv(name) != nullptr) return std::make_unique<Ranks>();
  return nullptr;
}

}  // namespace pfaff
