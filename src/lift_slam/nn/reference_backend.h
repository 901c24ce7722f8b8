#pragma once

#include <memory>

#include "lift_slam/nn/executor.h"

namespace lift_slam::nn {

// ApplyNetwork to each sample; always float32. Allocates as it goes.
std::unique_ptr<Executor> MakeReferenceExecutor(const Network& network, const Shape& input,
                                                const ExecutorOptions& options,
                                                std::shared_ptr<WorkerTeam> team);

}  // namespace lift_slam::nn
