// small_model_file FILE AXIS_FILE DEPTH_FILE: writes small_model() and both of small_axis_model() of small_model.h, for
// tests in other languages.
#include "small_model.h"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  svnet::io::write_model(argv[1], small_model());
  svnet::io::write_model(argv[2], small_axis_model());
  svnet::io::write_model(argv[3], small_axis_model(svnet::frame::DepthChoice::heights));
  return 0;
}
