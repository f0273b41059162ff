#pragma once
#include "base/enum_names.h"

// The choices of a configuration that belong to the training of SV-net alone.

namespace svnet::train {

/// Named settings of SV-net, which a configuration starts from (preset.h).
enum class Preset { paper, turns, best };
constexpr auto enum_table(Preset) {
  return std::to_array<EnumName<Preset>>({{Preset::paper, "paper"}, {Preset::turns, "turns"}, {Preset::best, "best"}});
}

/// Which score of a view SV-net learns.
enum class Target { individual, global };
constexpr auto enum_table(Target) {
  return std::to_array<EnumName<Target>>({{Target::individual, "individual"}, {Target::global, "global"}});
}

/// The head in a frame other than `camera` (head_fit.h). best: the one of the others that cross-validation over the
/// training categories chooses.
enum class HeadChoice { ridge, network, both, best };
constexpr auto enum_table(HeadChoice) {
  return std::to_array<EnumName<HeadChoice>>({{HeadChoice::ridge, "ridge"},
                                              {HeadChoice::network, "network"},
                                              {HeadChoice::both, "both"},
                                              {HeadChoice::best, "best"}});
}

/// Whether the model also learns which view to take next (next_head.h): not, or by ridge regression.
enum class NextViewChoice { none, ridge };
constexpr auto enum_table(NextViewChoice) {
  return std::to_array<EnumName<NextViewChoice>>({{NextViewChoice::none, "none"}, {NextViewChoice::ridge, "ridge"}});
}

/// How the score becomes what SV-net learns (view_targets.h).
enum class TargetScale { scaled, centred };
constexpr auto enum_table(TargetScale) {
  return std::to_array<EnumName<TargetScale>>({{TargetScale::scaled, "scaled"}, {TargetScale::centred, "centred"}});
}

/// In which symmetries (view/symmetry.h) SV-net sees the top image when it scores a view: as taken, or all of
/// them, averaged.
enum class Orientations { as_taken, all };
constexpr auto enum_table(Orientations) {
  return std::to_array<EnumName<Orientations>>({{Orientations::as_taken, "as_taken"}, {Orientations::all, "all"}});
}

/// Which part of the backbone is trained together with the head.
enum class FineTune { none, last_block, all };
constexpr auto enum_table(FineTune) {
  return std::to_array<EnumName<FineTune>>(
      {{FineTune::none, "none"}, {FineTune::last_block, "last_block"}, {FineTune::all, "all"}});
}

/// How training examples are multiplied. turns: each top image in all of its orientations.
enum class TopViewAugmentation { none, turns };
constexpr auto enum_table(TopViewAugmentation) {
  return std::to_array<EnumName<TopViewAugmentation>>(
      {{TopViewAugmentation::none, "none"}, {TopViewAugmentation::turns, "turns"}});
}

/// How several views of an object are clustered together.
///   mean         by the mean of their features
///   concatenate  by all their features
///   votes        each view by itself; then what most of these clusterings put together (semantics/co_association.h)
enum class ViewsTogether { mean, concatenate, votes };
constexpr auto enum_table(ViewsTogether) {
  return std::to_array<EnumName<ViewsTogether>>({{ViewsTogether::mean, "mean"},
                                                 {ViewsTogether::concatenate, "concatenate"},
                                                 {ViewsTogether::votes, "votes"}});
}

}  // namespace svnet::train
