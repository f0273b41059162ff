// small_model_file FILE: writes small_model() of small_model.h, for tests in other languages.
#include "small_model.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  svnet::io::write_model(argv[1], small_model());
  return 0;
}
