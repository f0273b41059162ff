#pragma once
#include "train/config/config.h"

namespace svnet::train {

/// The configuration that a preset starts from; `preset` says which.
///   paper  the defaults of Config: the two MLPs on pooled features of the top image as taken
///   turns  features of MobileNetV2 that are not pooled, in eight orientations, and a small head
///   best   ridge regression in the object's own axis, of scores with on-policy views; chosen by cross-validation over
///          the categories of a simulated collection (docs/benchmarks.md)
Config config_of(Preset preset);

}  // namespace svnet::train
