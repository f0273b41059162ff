#include "train/trained_from.h"

namespace svnet::train {

NodeId trained_from(FineTune fine_tune, const models::BackboneKind& kind, const Graph& graph, NodeId output) {
  switch (fine_tune) {
    case FineTune::none:
      return output;
    case FineTune::all:
      return graph.inputs().at(0);
    case FineTune::last_block:
      break;
  }
  const NodeId from = graph.find(kind.last_block_input);
  check(!graph.ancestors({from})[static_cast<std::size_t>(output)],
        "training.fine_tune: last_block, but sv_net.layer '", graph.node(output).name,
        "' is not above the input of the last block of ", kind.name, ", which is the output of '",
        kind.last_block_input, "'");
  return from;
}

}  // namespace svnet::train
