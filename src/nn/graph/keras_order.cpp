#include "nn/graph/keras_order.h"

#include <algorithm>

namespace svnet {

std::vector<NodeId> keras_order(const Graph& graph, NodeId output) {
  const auto count = graph.nodes().size();
  std::vector<int> met(count, -1);
  std::vector<NodeId> order, stack{output};
  while (!stack.empty()) {
    const NodeId id = stack.back();
    stack.pop_back();
    if (met[static_cast<std::size_t>(id)] >= 0) continue;
    met[static_cast<std::size_t>(id)] = static_cast<int>(order.size());
    order.push_back(id);
    const auto& inputs = graph.node(id).inputs;
    stack.insert(stack.end(), inputs.rbegin(), inputs.rend());
  }
  std::vector<int> depth(count, 0);
  for (std::size_t i = count; i-- > 0;)
    if (met[i] >= 0)
      for (NodeId input : graph.nodes()[i].inputs)
        depth[static_cast<std::size_t>(input)] = std::max(depth[static_cast<std::size_t>(input)], depth[i] + 1);
  std::sort(order.begin(), order.end(), [&](NodeId a, NodeId b) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    return depth[i] != depth[j] ? depth[i] > depth[j] : met[i] < met[j];
  });
  return order;
}

}  // namespace svnet
