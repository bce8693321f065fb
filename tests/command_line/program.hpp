// Runs the built program as a user would, and catches what it says.
#pragma once

#include <sys/types.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace formotion::program {

struct Said {
  int code = -1;
  std::string out, err;
};

// formotion with these arguments; input goes to its stdin.
Said run(const std::vector<std::string>& arguments, const std::string& input = "");
// Starts it and sends it the signal after this many milliseconds, if it still runs. code is -signal if it died of one.
Said run_and_signal(const std::vector<std::string>& arguments, int signal, int after_ms);

// The answers of `query` to these lines, asked at once. Throws where the program says anything else, or not as many.
std::vector<nlohmann::ordered_json> ask_all(const std::string& problem,
                                            const std::vector<nlohmann::ordered_json>& questions);
// A question about one configuration of the centre of mass.
nlohmann::ordered_json question(const std::string& type, double x_mm, double y_mm, double theta_deg,
                                const std::string& aspect = "up");
// An answer's contacts as "VE 4 [0,0]", sorted.
std::vector<std::string> contact_names(const nlohmann::ordered_json& answer);

// A folder of this test's own, gone afterwards.
struct Folder {
  Folder();
  ~Folder();
  std::string operator/(const std::string& name) const { return path + "/" + name; }
  std::string path;
};

// The program beside the test, killed when this goes.
class Running {
 public:
  explicit Running(const std::vector<std::string>& arguments);
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running();
  bool ended();
  Said finish();            // waits for its end
  std::string err() const;  // so far
  pid_t pid() const { return child_; }

 private:
  Folder folder_;
  pid_t child_;
  std::optional<int> status_;
};

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& text);
std::string shipped(const std::string& name);  // a problem under problems/feeder

}  // namespace formotion::program
