#include "progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace formotion {
namespace {

constexpr auto kBetweenLines = std::chrono::seconds(2);  // where no terminal is

std::string duration(double seconds) {
  char text[32];
  if (seconds < 90) {
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  } else if (seconds < 5400) {
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60);
  } else {
    std::snprintf(text, sizeof text, "%.1f h", seconds / 3600);
  }
  return text;
}

}  // namespace

Progress::Progress(const Problem& problem, std::int64_t budget, const RunState& state, bool json)
    : objectives_(problem.objectives().begin(), problem.objectives().end()),
      budget_(budget),
      before_(state.spent()),
      json_(json),
      terminal_(!json && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() { end_line(); }

void Progress::show(const RunState& state) {
  const RunProgress& now = state.history().back();
  const auto time = Clock::now();
  const double elapsed = std::chrono::duration<double>(time - begin_).count();
  const double rate = static_cast<double>(now.spent() - before_) / std::max(elapsed, 1e-9);
  const double left = static_cast<double>(budget_ - now.spent()) / std::max(rate, 1e-9);
  if (json_) {
    nlohmann::ordered_json line{{"evaluations", now.spent()},
                                {"budget", budget_},
                                {"per_second", rate},
                                {"seconds_left", left},
                                {"feasible", state.feasible_count()},
                                {"front", now.front_size},
                                {"best", nlohmann::ordered_json::object()}};
    for (std::size_t k = 0; k < now.best.size(); ++k) line["best"][objectives_[k].name] = now.best[k];
    std::fprintf(stderr, "%s\n", line.dump().c_str());
    return;
  }
  if (!terminal_ && time - last_ < kBetweenLines && now.spent() < budget_) return;
  last_ = time;
  std::string text = std::to_string(now.spent()) + " of " + std::to_string(budget_) + " evaluations, " +
                     std::to_string(std::lround(rate)) + "/s, front " + std::to_string(now.front_size);
  for (std::size_t k = 0; k < now.best.size(); ++k) {
    char best[96];
    std::snprintf(best, sizeof best, ", best %s %.4g", objectives_[k].name.c_str(), now.best[k]);
    text += best;
  }
  if (now.best.empty()) text += ", nothing feasible yet";
  text += ", " + duration(left) + " left";
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K%s", text.c_str());
    open_line_ = true;
  } else {
    std::fprintf(stderr, "%s\n", text.c_str());
  }
  std::fflush(stderr);
}

void Progress::say(const std::string& text) {
  end_line();
  if (json_) {
    std::fprintf(stderr, "%s\n", nlohmann::ordered_json{{"message", text}}.dump().c_str());
  } else {
    std::fprintf(stderr, "%s\n", text.c_str());
  }
}

void Progress::end_line() {
  if (open_line_) std::fputc('\n', stderr);
  open_line_ = false;
}

}  // namespace formotion
