#include <pfaff/bench/experiment/stage_text.hpp>

#include <cmath>

namespace pfaff {

namespace {
std::string about(double seconds) {
  const bool minutes = seconds >= 90, hours = seconds >= 5400;
  const double unit = hours ? 3600 : minutes ? 60 : 1;
  return "about " + std::to_string(std::lround(seconds / unit)) + (hours ? " h" : minutes ? " min" : " s");
}
}  // namespace

std::string StageText::at(const ExperimentStage& stage, double seconds) {
  if (stage.phase != phase_ || stage.all != all_) {
    phase_ = stage.phase;
    all_ = stage.all;
    begun_with_ = stage.done;
    begin_ = seconds;
  }
  std::string text = std::to_string(stage.phase) + "/" + std::to_string(ExperimentStage::phases);
  if (stage.done > begun_with_ && stage.all > stage.done) {
    const double pace = (seconds - begin_) / static_cast<double>(stage.done - begun_with_);
    text += ", " + about(pace * static_cast<double>(stage.all - stage.done)) + " left";
  }
  return text + ": " + stage.what;
}

}  // namespace pfaff
