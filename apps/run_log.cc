#include "apps/run_log.h"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <mutex>

#include "lift_slam/util/input_error.h"

namespace lift_slam {

struct RunLog::Implementation {
  explicit Implementation(std::vector<spdlog::sink_ptr> sinks)
      : logger("lift_slam", sinks.begin(), sinks.end()) {}

  spdlog::logger logger;
  std::mutex mutex;
  std::string write_error;  // guarded by mutex
};

namespace {

spdlog::sink_ptr FileSink(const std::filesystem::path& path) {
  try {
    auto sink =
        std::make_shared<spdlog::sinks::basic_file_sink_mt>(path.string(), /*truncate=*/true);
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
    return sink;
  } catch (const spdlog::spdlog_ex&) {
    throw InputError(fmt::format("{}: cannot create the file", path.string()));
  }
}

spdlog::sink_ptr StderrSink() {
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  sink->set_level(spdlog::level::warn);
  // On a terminal a progress bar may stand on the line: it is wiped and will be drawn anew below.
  sink->set_pattern(isatty(STDERR_FILENO) != 0 ? "\r\x1b[Klift_slam: %l: %v" : "lift_slam: %l: %v");
  return sink;
}

}  // namespace

RunLog::RunLog(const std::filesystem::path& path)
    : implementation_(std::make_unique<Implementation>(std::vector{FileSink(path), StderrSink()})) {
  spdlog::logger& logger = implementation_->logger;
  logger.flush_on(spdlog::level::info);  // a killed run leaves its log
  logger.set_error_handler([self = implementation_.get()](const std::string& message) {
    const std::lock_guard lock(self->mutex);
    if (self->write_error.empty()) self->write_error = message;
  });
}

RunLog::~RunLog() = default;

void RunLog::Info(std::string_view message) {
  implementation_->logger.log(spdlog::level::info, message);
}

void RunLog::Warning(std::string_view message) {
  implementation_->logger.log(spdlog::level::warn, message);
}

std::string RunLog::WriteError() const {
  const std::lock_guard lock(implementation_->mutex);
  return implementation_->write_error;
}

}  // namespace lift_slam
