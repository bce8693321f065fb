// What runs independent pieces of work side by side.
#pragma once

#include <functional>

namespace formotion {

// Calls work(0) ... work(count - 1), in any order, on at most `threads` threads (0: one per core); returns when all are
// done. TBB, or plain threads (FORMOTION_EXECUTOR=std: the thread sanitizer understands those).
// If a piece throws, pieces not yet begun are left out and one of the exceptions is thrown again here.
void run_parallel(int count, int threads, const std::function<void(int)>& work);

}  // namespace formotion
