#include "program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace formotion::program {
namespace fs = std::filesystem;
namespace {

pid_t start(const std::vector<std::string>& arguments, const std::string& in, const std::string& out,
            const std::string& err) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const auto redirect = [](const std::string& path, int flags, int to) {
    const int file = ::open(path.c_str(), flags, 0666);
    if (file < 0 || ::dup2(file, to) < 0) ::_exit(127);
  };
  redirect(in, O_RDONLY, STDIN_FILENO);
  redirect(out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  redirect(err, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
  std::vector<char*> words{const_cast<char*>(FORMOTION_PROGRAM)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  ::execv(FORMOTION_PROGRAM, words.data());
  ::_exit(127);
}

Said said(int status, const Folder& folder) {
  return {WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status), read_file(folder / "out"),
          read_file(folder / "err")};
}

Said finish(pid_t child, const Folder& folder) {
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) throw std::runtime_error("the program could not be run");
  return said(status, folder);
}

}  // namespace

Said run(const std::vector<std::string>& arguments, const std::string& input) {
  const Folder folder;
  write_file(folder / "in", input);
  return finish(start(arguments, folder / "in", folder / "out", folder / "err"), folder);
}

Said run_and_signal(const std::vector<std::string>& arguments, int signal, int after_ms) {
  const Folder folder;
  write_file(folder / "in", "");
  const pid_t child = start(arguments, folder / "in", folder / "out", folder / "err");
  ::usleep(static_cast<useconds_t>(1000 * after_ms));
  ::kill(child, signal);
  return finish(child, folder);
}

std::vector<nlohmann::ordered_json> ask_all(const std::string& problem,
                                            const std::vector<nlohmann::ordered_json>& questions) {
  std::string input;
  for (const nlohmann::ordered_json& question : questions) input += question.dump() + "\n";
  const Said said = run({"query", problem}, input);
  if (said.code != 0 || !said.err.empty()) throw std::runtime_error("query failed: " + said.err);
  std::vector<nlohmann::ordered_json> answers;
  std::istringstream stream(said.out);
  for (std::string line; std::getline(stream, line);) answers.push_back(nlohmann::ordered_json::parse(line));
  if (answers.size() != questions.size()) throw std::runtime_error("not an answer a line: " + said.out);
  return answers;
}

nlohmann::ordered_json question(const std::string& type, double x_mm, double y_mm, double theta_deg,
                                const std::string& aspect) {
  return {
      {"id", 1}, {"type", type}, {"aspect", aspect}, {"q", {{"x_mm", x_mm}, {"y_mm", y_mm}, {"theta_deg", theta_deg}}}};
}

std::vector<std::string> contact_names(const nlohmann::ordered_json& answer) {
  std::vector<std::string> all;
  for (const nlohmann::ordered_json& contact : answer.at("contacts")) {
    all.push_back(contact.at("type").get<std::string>() + " " + contact.at("moving").dump() + " " +
                  contact.at("fixed").dump());
  }
  std::sort(all.begin(), all.end());
  return all;
}

Folder::Folder() {
  std::string pattern = (fs::temp_directory_path() / "formotion_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path = pattern;
}
Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

Running::Running(const std::vector<std::string>& arguments) {
  for (const char* file : {"in", "out", "err"}) write_file(folder_ / file, "");
  child_ = start(arguments, folder_ / "in", folder_ / "out", folder_ / "err");
  if (child_ < 0) throw std::runtime_error("the program could not be run");
}
Running::~Running() {
  if (ended()) return;
  ::kill(child_, SIGKILL);
  ::waitpid(child_, nullptr, 0);
}
bool Running::ended() {
  int status = 0;
  if (!status_ && ::waitpid(child_, &status, WNOHANG) == child_) status_ = status;
  return status_.has_value();
}
Said Running::finish() {
  while (!ended()) ::usleep(5000);
  return said(*status_, folder_);
}
std::string Running::err() const { return read_file(folder_ / "err"); }

std::string read_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("no file " + path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_file(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string shipped(const std::string& name) { return FORMOTION_SOURCE_DIR "/problems/feeder/" + name; }

}  // namespace formotion::program
