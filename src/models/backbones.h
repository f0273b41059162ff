#pragma once
#include "models/backbone_kind.h"

namespace svnet::models {

// Each backbone is described in the source file of its name, and listed here.

BackboneKind vgg16();
BackboneKind vgg19();
BackboneKind xception();
BackboneKind mobilenet();
BackboneKind mobilenet_v2();
BackboneKind tiny_xception();

/// Every backbone that is known by name, in the order of lists for users.
inline constexpr BackboneKind (*kBackbones[])() = {vgg16, vgg19, xception, mobilenet, mobilenet_v2, tiny_xception};

}  // namespace svnet::models
