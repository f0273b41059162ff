#pragma once
#include "models/backbone.h"
#include "nn/graph/graph.h"
#include "train/config/config.h"

namespace svnet::train {

/// The head of sv_net in the frame `camera`, on the features of a backbone.
Graph camera_head(const Config& config, const models::Backbone& backbone);

/// The node of the backbone whose output the trained layers start from.
NodeId first_trained(const Config& config, const models::Backbone& backbone);

/// What is trained in the frame `camera`: the head, and the layers of the backbone after first_trained()
/// (models/trained_graph.h).
Graph trained_network(const Config& config, const models::Backbone& backbone);

}  // namespace svnet::train
