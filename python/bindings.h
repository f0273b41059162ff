#pragma once
#include <pybind11/pybind11.h>

namespace svnet::python {

// Each function adds the contents of one file to the module svnet._svnet.
void bind_camera_pose(pybind11::module_& module);
void bind_clustering(pybind11::module_& module);
void bind_grouping(pybind11::module_& module);
void bind_cluster_metrics(pybind11::module_& module);
void bind_scores(pybind11::module_& module);
void bind_backbone(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_pose_grid(pybind11::module_& module);

}  // namespace svnet::python
