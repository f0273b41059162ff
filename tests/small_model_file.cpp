// small_model_file FILE AXIS_FILE DEPTH_FILE TURNED_FILE: writes small_model(), both of small_axis_model(), the first
// with a head of the next view, and small_turned_model() of small_model.h, for tests in other languages.
#include "small_model.h"

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  svnet::io::write_model(argv[1], small_model());
  svnet::Model axis_model = small_axis_model();
  set_small_next_head(axis_model);
  svnet::io::write_model(argv[2], axis_model);
  svnet::io::write_model(argv[3], small_axis_model(svnet::frame::DepthChoice::heights));
  svnet::io::write_model(argv[4], small_turned_model());
  return 0;
}
