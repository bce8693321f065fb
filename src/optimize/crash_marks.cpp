#include "optimize/crash_marks.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <memory>

#include "optimize/run_store.hpp"

namespace formotion {

constexpr std::uint64_t kMagic = 0x31736b72616d7463;
constexpr std::size_t kSlotBytes = 4096, kSlots = 255, kMostValues = 500;
constexpr int kFatalSignals[] = {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL};

struct MarkHeader {
  std::uint64_t magic;
  std::int64_t generation;
};

struct MarkSlot {
  std::atomic<std::uint32_t> claimed;
  std::atomic<std::uint32_t> scoring;  // what follows is whole
  std::atomic<std::uint64_t> number;
  std::int32_t signal;
  std::int32_t stage, place;
  std::uint32_t count;
  double values[kMostValues];
};
static_assert(sizeof(MarkSlot) <= kSlotBytes && std::atomic<std::uint64_t>::is_always_lock_free);

namespace {

constexpr std::size_t kFileBytes = kSlotBytes * (1 + kSlots);

constinit thread_local MarkSlot* current = nullptr;  // the mark of this thread

void note(int signal, siginfo_t* info, void*) {
  const bool from_outside = info->si_code <= 0 && info->si_pid != ::getpid();
  if (current && !from_outside) current->signal = signal;
  ::raise(signal);  // the default action is back (SA_RESETHAND); it comes when the handler returns
}

// A stack overflow leaves no stack to handle it on.
void give_this_thread_a_signal_stack() {
  static constexpr std::size_t kBytes = 16384;
  struct Stack {
    std::unique_ptr<char[]> memory = std::make_unique<char[]>(kBytes);
    Stack() {
      stack_t stack{};
      stack.ss_sp = memory.get();
      stack.ss_size = kBytes;
      ::sigaltstack(&stack, nullptr);
    }
    ~Stack() {
      stack_t none{};
      none.ss_flags = SS_DISABLE;
      ::sigaltstack(&none, nullptr);
    }
  };
  thread_local const Stack stack;
  (void)stack;
}

const MarkSlot& slot_at(const char* memory, std::size_t i) {
  return *reinterpret_cast<const MarkSlot*>(memory + kSlotBytes * (1 + i));
}

std::vector<Mark> marks_in(const char* memory) {
  std::vector<Mark> marks;
  for (std::size_t i = 0; i < kSlots; ++i) {
    const MarkSlot& slot = slot_at(memory, i);
    if (!slot.scoring.load(std::memory_order_acquire)) continue;
    const std::size_t count = std::min<std::size_t>(slot.count, kMostValues);
    marks.push_back({{slot.stage != 0, slot.place, {slot.values, slot.values + count}}, slot.signal, slot.number});
  }
  return marks;
}

MarkHeader* mapped(int file) {
  void* memory =
      ::mmap(nullptr, kFileBytes, PROT_READ | PROT_WRITE, file < 0 ? MAP_SHARED | MAP_ANONYMOUS : MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) throw StoreError(std::string("crash marks cannot be mapped: ") + std::strerror(errno));
  return static_cast<MarkHeader*>(memory);
}

}  // namespace

CrashMarks::CrashMarks(const std::string& path, std::int64_t generation) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) throw StoreError(path + ": " + std::strerror(errno));
  if (const int error = ::posix_fallocate(file, 0, static_cast<off_t>(kFileBytes)); error != 0) {
    ::close(file);
    throw StoreError(path + ": " + std::strerror(error));
  }
  memory_ = mapped(file);
  ::close(file);
  *memory_ = {kMagic, generation};
}

CrashMarks::CrashMarks() : memory_(mapped(-1)) {}

CrashMarks::~CrashMarks() { ::munmap(memory_, kFileBytes); }

std::vector<Mark> CrashMarks::ended_by_signal(const std::string& path, std::int64_t generation) {
  std::ifstream stream(path, std::ios::binary);
  const auto memory = std::make_unique<std::uint64_t[]>(kFileBytes / sizeof(std::uint64_t));
  auto* bytes = reinterpret_cast<char*>(memory.get());
  if (!stream.read(bytes, static_cast<std::streamsize>(kFileBytes))) return {};
  const auto* header = reinterpret_cast<const MarkHeader*>(bytes);
  if (header->magic != kMagic || header->generation != generation) return {};
  std::vector<Mark> marks = marks_in(bytes);
  std::erase_if(marks, [](const Mark& mark) { return mark.signal == 0; });
  return marks;
}

std::vector<Mark> CrashMarks::marks() const { return marks_in(reinterpret_cast<const char*>(memory_)); }

MarkSlot* CrashMarks::claim() {
  auto* memory = reinterpret_cast<char*>(memory_);
  for (std::size_t i = 0; i < kSlots; ++i) {
    auto& slot = const_cast<MarkSlot&>(slot_at(memory, i));
    if (!slot.claimed.load(std::memory_order_relaxed) && !slot.claimed.exchange(1)) return &slot;
  }
  return nullptr;
}

CrashMarks::Scoring::Scoring(CrashMarks* marks, const Subject& subject) : outer_(current) {
  if (!marks || subject.values.size() > kMostValues) return;
  slot_ = marks->claim();
  if (!slot_) return;
  give_this_thread_a_signal_stack();
  slot_->signal = 0;
  slot_->stage = subject.stage;
  slot_->place = subject.place;
  slot_->count = static_cast<std::uint32_t>(subject.values.size());
  std::copy(subject.values.begin(), subject.values.end(), slot_->values);
  slot_->number.fetch_add(1, std::memory_order_relaxed);
  slot_->scoring.store(1, std::memory_order_release);
  current = slot_;
}

CrashMarks::Scoring::~Scoring() {
  if (!slot_) return;
  current = outer_;
  slot_->scoring.store(0, std::memory_order_release);
  slot_->claimed.store(0, std::memory_order_release);
}

void note_fatal_signals() {
  struct sigaction action {};
  action.sa_sigaction = note;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | static_cast<int>(SA_RESETHAND);
  ::sigemptyset(&action.sa_mask);
  for (const int signal : kFatalSignals) ::sigaction(signal, &action, nullptr);
}

}  // namespace formotion
