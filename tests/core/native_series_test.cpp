// Series that are compiled from tapes agree with SeriesReplay, in every recurrence and number of lanes, and
// a collocation by them with one that is put together here from the replay.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/core/native/compiled_model.hpp>
#include <pfaff/core/tape/series.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

// Every operation that series have, with constants on either side, of the state and of the time alone. The
// last result is an input as it is, the one before it a constant.
Tape formula() {
  return record(4, 4, [](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
    const Recorded wave = sin(2 * t) * exp(-t / 3), safe = z[0] * z[0] + 2;
    out[0] = -z[1] / safe + cos(z[2]) * sin(z[2]) - wave * sqrt(safe) + (3 - z[3]) * 0.3_r + erf(z[2] - t);
    out[1] = log(safe) * pow(safe, -1.7_r) + exp(z[1] * z[2]) + select(z[0] - z[1], z[3] - 1, cos(t) * z[0]) +
             atan(z[2] * z[3]) + 2 / safe + z[0] * z[3] * wave;
    out[2] = Recorded(0.25_r);
    out[3] = z[1];
  });
}

// A canonical system with this field and no author's code.
std::shared_ptr<const Model> model() {
  ModelSource source;
  source.name = "series";
  source.dimension = 4;
  source.canonical = true;
  for (const Formula f : {Formula::hamiltonian, Formula::field, Formula::chart_field})
    source.given[index(f)] = std::make_shared<const Tape>(
        f == Formula::hamiltonian
            ? record(4, 1, [](const Recorded&, In<Recorded> z, Out<Recorded> out) { out[0] = z[0] * z[1]; })
            : formula());
  return std::make_shared<const Model>(std::move(source));
}

class NativeSeries : public ::testing::Test {
 protected:
  NativeSeries() { setenv("XDG_CACHE_HOME", (directory_ / "cache").c_str(), 1); }
  ~NativeSeries() override { unsetenv("XDG_CACHE_HOME"); }

 private:
  TemporaryDirectory directory_;
};

// Columns and weights of no particular method.
template <int W>
SeriesCombination<W> combination(std::size_t levels, bool symmetric, bool one_kind) {
  SeriesCombination<W> c;
  c.levels = levels;
  c.symmetric = symmetric;
  c.one_kind = one_kind;
  c.kind = one_kind ? std::vector<std::size_t>{0, 0, 0, 0} : std::vector<std::size_t>{0, 1, 0, 1};
  for (std::size_t matrix = 0; matrix < (one_kind ? levels : 2 * levels); ++matrix) {
    std::array<Pack<W>, W> columns{};
    for (std::size_t j = 0; j < W; ++j)
      for (std::size_t i = 0; i < W; ++i)
        columns[j].set(i,
                       0.1 * std::cos(static_cast<double>(1 + matrix) + static_cast<double>(3 * i + 5 * j)));
    c.columns.push_back(columns);
  }
  for (std::size_t i = 0; i < W; ++i) c.weight.set(i, 0.3 + 0.1 * static_cast<double>(i));
  return c;
}

// The largest difference between the compiled collocation and the one by replay.
template <int W>
double series_difference(const Model& compiled_model, std::size_t levels, bool symmetric, bool one_kind) {
  const CompiledSeries& series = *compiled_model.chart_field_series();
  const SeriesWidth<W>& width = series.template width<W>();
  const auto c = combination<W>(levels, symmetric, one_kind);
  const std::array<double, 4> z{0.7, -0.4, 0.3, 1.1};
  std::array<double, W> t0{}, t1{};
  t0.fill(0.2);
  for (std::size_t i = 0; i < W; ++i) t1[i] = 0.05 * static_cast<double>(i + 1);

  std::vector<Pack<W>> slots(static_cast<std::size_t>(series.layout(compiled_model.system()).slots) *
                             series_capacity);
  slots[4 * series_capacity] = Pack<W>(0.2);
  for (std::size_t i = 0; i < W; ++i) slots[4 * series_capacity + 1].set(i, t1[i]);
  EXPECT_TRUE(series.layout(compiled_model.system()).timed);
  width.time(compiled_model.system(), slots.data(), static_cast<int>(levels));
  std::array<double, 4> found{};
  width.best(c)(compiled_model.system(), slots.data(), c, z.data(), found.data());

  SeriesReplay<double> replay(compiled_model.tape(Formula::chart_field), static_cast<int>(levels), W);
  replay.set_time(t0.data(), t1.data());
  std::vector<double> input(4 * W);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < W; ++i) input[k * W + i] = z[k];
  std::array<double, 4> expected{};
  for (std::size_t level = 0; level < levels; ++level) {
    replay.set_input(level, input.data());
    replay.advance(level);
    for (std::size_t k = 0; k < 4; ++k) {
      const double* x = replay.output(k, level);
      const auto& columns = c.columns[c.kind[k] * levels + level];
      for (std::size_t i = 0; i < W; ++i) {
        if (!symmetric || level % 2 == 0) expected[k] += c.weight[i] * x[i];
        input[k * W + i] = 0;
        for (std::size_t j = 0; j < W; ++j) input[k * W + i] += columns[j][i] * x[j];
      }
    }
  }
  double worst = 0;
  for (std::size_t k = 0; k < 4; ++k)
    worst = std::max(worst, std::abs(found[k] - expected[k]) / std::max(1.0, std::abs(expected[k])));
  return worst;
}

TEST_F(NativeSeries, EveryRecurrenceGivesWhatTheReplayGives) {
  const auto made = compiled(model());
  ASSERT_NE(made->chart_field_series(), nullptr);
  // Sums of some hundred roundings of numbers of order one, taken in another order.
  constexpr double tolerance = 1e-14;
  EXPECT_EQ(made->chart_field_series()->one.known, 3U) << "compiled without loops";
  for (const bool symmetric : {false, true})
    for (const bool one_kind : {false, true})
      for (const std::size_t levels : {1U, 3U, 6U, 7U, 11U, 15U}) {
        SCOPED_TRACE(levels);
        EXPECT_LE(series_difference<1>(*made, levels, symmetric, one_kind), tolerance);
        EXPECT_LE(series_difference<2>(*made, levels, symmetric, one_kind), tolerance);
        EXPECT_LE(series_difference<4>(*made, levels, symmetric, one_kind), tolerance);
      }
}

TEST_F(NativeSeries, TapesThatSolveSystemsAreLeftToTheReplay) {
  const Tape tape = record(2, 2, [](const Recorded&, In<Recorded> z, Out<Recorded> out) {
    const std::vector<Recorded> matrix{z[0], z[1], Recorded(1), z[0]}, right{z[1], z[0]};
    const auto x = solve(matrix, right);
    out[0] = x[0];
    out[1] = x[1];
  });
  ModelSource source;
  source.name = "solving";
  source.dimension = 2;
  source.canonical = true;
  source.given[index(Formula::field)] = std::make_shared<const Tape>(tape);
  source.given[index(Formula::hamiltonian)] = std::make_shared<const Tape>(
      record(2, 1, [](const Recorded&, In<Recorded> z, Out<Recorded> out) { out[0] = z[0]; }));
  const auto made = compiled(std::make_shared<const Model>(std::move(source)));
  EXPECT_EQ(made->chart_field_series(), nullptr);
  EXPECT_NE(made->compiled(Formula::field), nullptr);
}

}  // namespace
