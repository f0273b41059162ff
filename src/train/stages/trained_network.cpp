#include "train/stages/trained_network.h"

#include "models/sv_net.h"
#include "models/trained_graph.h"
#include "train/trained_from.h"

namespace svnet::train {

Graph camera_head(const Config& config, const models::Backbone& backbone) {
  return models::sv_net({.features = backbone.dimension(),
                         .width = config.sv_net.width,
                         .dropout = config.sv_net.dropout,
                         .angles = config.sv_net.angles});
}

NodeId first_trained(const Config& config, const models::Backbone& backbone) {
  return trained_from(config.training.fine_tune, backbone.kind(), backbone.graph(),
                      backbone.graph().find(backbone.output_name()));
}

Graph trained_network(const Config& config, const models::Backbone& backbone) {
  return models::trained_graph(backbone.graph(), first_trained(config, backbone),
                               backbone.graph().find(backbone.output_name()), camera_head(config, backbone));
}

}  // namespace svnet::train
