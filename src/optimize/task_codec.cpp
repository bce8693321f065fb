#include "optimize/task_codec.hpp"

#include <concepts>
#include <cstring>
#include <type_traits>

namespace formotion {
namespace {

constexpr std::uint64_t kFormat = 0x3130776f746d7266;  // raised with every change of the format

// Every struct that travels names its fields here, twice: once to bind them, which does not compile when one was added
// or taken away, and once to pass them on (the tests change every field and look whether the bytes change).
template <class Codec>
void fields(Codec& codec, StageAim& it) {
  auto& [kind, keep, lose, length_weight] = it;
  codec(kind, keep, lose, length_weight);
}
template <class Codec>
void fields(Codec& codec, Candidate& it) {
  auto& [topology, values] = it;
  codec(topology, values);
}
template <class Codec>
void fields(Codec& codec, Merit& it) {
  auto& [focus, at_most, scale] = it;
  codec(focus, at_most, scale);
}
template <class Codec>
void fields(Codec& codec, SearchTask& it) {
  auto& [driver, stage, topology, evaluations, seed, first_point, start, listed, step, merit, provenance] = it;
  codec(driver, stage, topology, evaluations, seed, first_point, start, listed, step, merit, provenance);
}
template <class Codec>
void fields(Codec& codec, Score& it) {
  auto& [feasible, violation, objectives, worst_case, bites, work, failure, failure_text] = it;
  codec(feasible, violation, objectives, worst_case, bites, work, failure, failure_text);
}
template <class Codec>
void fields(Codec& codec, Trial& it) {
  auto& [candidate, score] = it;
  codec(candidate, score);
}
template <class Codec>
void fields(Codec& codec, StageEnd& it) {
  auto& [to, nominal_mm, lacking_mm] = it;
  codec(to, nominal_mm, lacking_mm);
}
template <class Codec>
void fields(Codec& codec, StageResult& it) {
  auto& [valid, violation, ends, length_mm, work] = it;
  codec(valid, violation, ends, length_mm, work);
}
template <class Codec>
void fields(Codec& codec, StageTrial& it) {
  auto& [kind, values, result, demanded, tolerance_mm, work] = it;
  codec(kind, values, result, demanded, tolerance_mm, work);
}
template <class Codec>
void fields(Codec& codec, TaskResult& it) {
  auto& [trials, stages] = it;
  codec(trials, stages);
}
template <class Codec>
void fields(Codec& codec, Subject& it) {
  auto& [stage, place, values] = it;
  codec(stage, place, values);
}
template <class Codec>
void fields(Codec& codec, Incident& it) {
  auto& [subject, failure, text, times] = it;
  codec(subject, failure, text, times);
}
template <class Codec>
void fields(Codec& codec, WorkOrder& it) {
  auto& [tasks, quarantine, candidate_seconds] = it;
  codec(tasks, quarantine, candidate_seconds);
}
template <class Codec>
void fields(Codec& codec, WorkReport& it) {
  auto& [results, incidents, error] = it;
  codec(results, incidents, error);
}

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

class Writer {
 public:
  template <class... Items>
  void operator()(Items&... items) {
    (write(items), ...);
  }
  std::string bytes;

 private:
  template <Plain T>
  void write(T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void write(std::string& text) {
    write_size(text.size());
    bytes += text;
  }
  void write(std::vector<bool>& flags) {
    write_size(flags.size());
    for (bool flag : flags) write(flag);
  }
  template <class T>
  void write(std::vector<T>& items) {
    write_size(items.size());
    for (T& item : items) write(item);
  }
  template <class T>
  void write(std::optional<T>& item) {
    bool there = item.has_value();
    write(there);
    if (item) write(*item);
  }
  template <class T>
  void write(T& item) {
    fields(*this, item);
  }
  void write_size(std::size_t size) { write(size); }
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : left_(bytes) {}
  template <class... Items>
  void operator()(Items&... items) {
    (read(items), ...);
  }
  bool at_end() const { return left_.empty(); }

 private:
  template <Plain T>
  void read(T& value) {
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  void read(bool& value) {
    char byte = 0;
    read(byte);
    value = byte != 0;
  }
  void read(std::string& text) { text = take(size()); }
  void read(std::vector<bool>& flags) {
    flags.assign(size(), false);
    for (std::size_t i = 0; i < flags.size(); ++i) {
      bool flag = false;
      read(flag);
      flags[i] = flag;
    }
  }
  template <class T>
  void read(std::vector<T>& items) {
    items.resize(size());
    for (T& item : items) read(item);
  }
  template <class T>
  void read(std::optional<T>& item) {
    bool there = false;
    read(there);
    if (there) read(item.emplace());
  }
  template <class T>
  void read(T& item) {
    fields(*this, item);
  }

  // Every item takes a byte at least, so no damaged number can ask for more memory than the bytes are long.
  std::size_t size() {
    std::size_t count = 0;
    read(count);
    if (count > left_.size()) throw DamagedBytes("bytes of a task are cut short");
    return count;
  }
  std::string_view take(std::size_t count) {
    if (count > left_.size()) throw DamagedBytes("bytes of a task are cut short");
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }
  std::string_view left_;
};

template <class T>
std::string bytes_of(T item) {  // a copy: one set of fields() serves reading and writing
  Writer writer;
  std::uint64_t format = kFormat;
  writer(format, item);
  std::uint64_t sum = checksum(writer.bytes);
  writer(sum);
  return std::move(writer.bytes);
}

template <class T>
T item_of(std::string_view bytes) {
  std::uint64_t format = 0, sum = 0;
  if (bytes.size() < sizeof format + sizeof sum) throw DamagedBytes("bytes of a task are cut short");
  const std::string_view content = bytes.substr(0, bytes.size() - sizeof sum);
  std::memcpy(&sum, bytes.data() + content.size(), sizeof sum);
  std::memcpy(&format, bytes.data(), sizeof format);
  if (format != kFormat) throw DamagedBytes("bytes of another format");
  if (sum != checksum(content)) throw DamagedBytes("bytes of a task are damaged");
  Reader reader(content.substr(sizeof format));
  T item;
  reader(item);
  if (!reader.at_end()) throw DamagedBytes("bytes of a task go on after their end");
  return item;
}

}  // namespace

std::string encoded(const WorkOrder& order) { return bytes_of(order); }
std::string encoded(const WorkReport& report) { return bytes_of(report); }
WorkOrder decoded_order(std::string_view bytes) { return item_of<WorkOrder>(bytes); }
WorkReport decoded_report(std::string_view bytes) { return item_of<WorkReport>(bytes); }

}  // namespace formotion
