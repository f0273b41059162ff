#include "model_writer.h"

#include "small_model.h"

void write_small_model(const std::string& path) { svnet::io::write_model(path, small_model()); }

void write_depth_model(const std::string& path) {
  svnet::io::write_model(path, small_axis_model(svnet::frame::DepthChoice::heights));
}
