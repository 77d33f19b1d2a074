#include <pfaff/papers/rows.hpp>

#include <cmath>

#include <pfaff/core/errors/budget.hpp>

namespace pfaff {

std::string shown(const Numbers& x) {
  Quad largest(1);
  for (const Quad& v : x)
    if (abs(v) > largest) largest = abs(v);
  std::string text;
  for (const Quad& v : x) {
    if (!text.empty()) text += ' ';
    text += abs(v) <= Quad(at_round_off) * largest ? "0" : to_string(v, 6);
  }
  return text;
}
std::string shown(double x) { return std::abs(x) <= at_round_off ? "0" : to_string(Quad(x), 4); }

void Rows::add(const std::string& equation, const std::string& what, const Texts& texts, Evidence evidence,
               const std::string& entry) {
  spend(0, 0);  // between any two rows it may have been asked to stop
  ReproducedRow row;
  row.id = equation + " " + what;
  row.section = section_;
  row.equation = equation;
  row.printed = texts.printed;
  row.ours = texts.ours;
  const bool numbers = !evidence.printed.empty();
  row.difference = numbers ? distance(evidence.printed, evidence.ours) : evidence.conditions.front().value;
  row.tolerance = numbers ? evidence.tolerance : evidence.conditions.front().bound;
  row.status = judge(evidence);
  row.erratum = entry;
  row.evidence = std::move(evidence);
  rows_.push_back(std::move(row));
}

void Rows::reproduced(const std::string& equation, const std::string& what, const Numbers& printed,
                      const Numbers& ours) {
  add(equation, what, {shown(printed), shown(ours)},
      {Evidence::Kind::value, printed, {}, ours, {}, at_round_off}, "");
}
void Rows::published(const std::string& equation, const std::string& what,
                     const std::vector<std::string>& printed, const Numbers& ours, double tolerance) {
  Texts texts;
  Numbers numbers;
  for (const std::string& digits : printed) {
    texts.printed += (texts.printed.empty() ? "" : " ") + digits;
    if (!parse(digits, numbers.emplace_back())) throw RunError("'" + digits + "' is no number");
  }
  for (const Quad& x : ours) texts.ours += (texts.ours.empty() ? "" : " ") + to_string(x, 17);
  add(equation, what, texts, {Evidence::Kind::value, numbers, {}, ours, {}, tolerance}, "");
}
void Rows::order(const std::string& equation, const std::string& what, double printed, double measured,
                 double tolerance) {
  add(equation, what, {shown(printed), shown(measured)},
      {Evidence::Kind::order, {Quad(printed)}, {}, {Quad(measured)}, {}, tolerance}, "");
}
void Rows::erratum(const std::string& equation, const std::string& what, const Numbers& printed,
                   const Numbers& corrected, const Numbers& ours, const std::string& entry) {
  add(equation, what, {shown(printed), shown(ours)},
      {Evidence::Kind::misprint, printed, corrected, ours, {}, at_round_off}, entry);
}
void Rows::claim(const std::string& equation, const std::string& what, const Texts& texts,
                 const std::vector<Condition>& conditions, const std::string& entry) {
  add(equation, what, texts, {Evidence::Kind::claim, {}, {}, {}, conditions, at_round_off}, entry);
}
void Rows::qualitative(const std::string& equation, const std::string& what, const Texts& texts,
                       const std::vector<Condition>& conditions, const std::string& tested) {
  add(equation, what, texts, {Evidence::Kind::property, {}, {}, {}, conditions, at_round_off}, tested);
}

}  // namespace pfaff
