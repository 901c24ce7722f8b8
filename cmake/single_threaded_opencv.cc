// Linked into the tests of the thread sanitizer preset: OpenCV's own worker threads (TBB, not
// instrumented) would be reported as races. The program turns them off as well (image_threads.h).
#include <opencv2/core/utility.hpp>

namespace {
[[maybe_unused]] const bool kDone = (cv::setNumThreads(1), true);
}  // namespace
