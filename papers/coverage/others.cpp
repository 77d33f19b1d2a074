// Published numbers of other works: what has rows, and what does not yet.
#include <pfaff/papers/coverage/coverage.hpp>

namespace pfaff {

const std::vector<PaperItem>& others_items() {
  static const std::vector<PaperItem> items{
      {"enright-pryce1987 D1", ItemKind::number},
      {"enright-pryce1987 D2", ItemKind::number},
      {"enright-pryce1987 D3", ItemKind::number},
      {"enright-pryce1987 D4", ItemKind::number},
      {"enright-pryce1987 D5", ItemKind::number},
      {"enright-pryce1987 B1", ItemKind::number},
      {"enright-pryce1987 B5", ItemKind::number},
      {"mazzia-magherini2008 Pleiades", ItemKind::number},
      {"abramowitz-stegun1964 17.3", ItemKind::number},
      {"reynolds-gardner-woodward-chinomona2023 Kepler", ItemKind::number},
      {"rackauckas-nie2017 quadrupole boson", ItemKind::number},
      {"hairer-lubich-wanner2006 I.2.3", ItemKind::statement},
      {"hairer-lubich-wanner2006 I.2.4", ItemKind::statement},
      {"quinlan-tremaine1990", ItemKind::statement},
      {"feng-qin2010 15.6", ItemKind::number},
      {"feng-qin2010 15.6 lower nu", ItemKind::number, Cover::pending,
       "scheme (5.8) is said to be behind the midpoint rule below nu = 1.33 too; the largest, mean and final "
       "errors of r and of r' do not show it"},
      {"mclachlan-perlmutter2006", ItemKind::statement},
      {"henon-heiles1964", ItemKind::statement},
      {"antonana-makazaga-murua2017 round-off", ItemKind::number, Cover::pending,
       "2.7e-18 times the root of the number of steps, of the double pendulum with Gauss of 6 stages: takes "
       "an "
       "ensemble of half a million steps each"}};
  return items;
}

}  // namespace pfaff
