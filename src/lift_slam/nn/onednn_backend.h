#pragma once

#include <memory>

#include "lift_slam/nn/executor.h"

namespace lift_slam::nn {

// Convolutions and fully connected layers by oneDNN with the activation fused, weights in its own
// order; the other layers by VectorLayer. Layers of one input channel stay in float32 whatever the
// precision: they gain nothing from less.
std::unique_ptr<Executor> MakeOneDnnExecutor(const Network& network, const Shape& input,
                                             const ExecutorOptions& options,
                                             PrecisionChoice precision,
                                             std::shared_ptr<WorkerTeam> team);

}  // namespace lift_slam::nn
