/* Loads a model and prints the status and the error, for c_api_test.cpp to run with variables in its environment. */
#include <stdio.h>

#include "svnet/svnet.h"

int main(int argc, char** argv) {
  svnet_model* model = NULL;
  const svnet_status status = svnet_model_load(argc > 1 ? argv[1] : "", &model);
  printf("%d %s %s\n", (int)status, model == NULL ? "none" : "model", svnet_last_error());
  svnet_model_free(model);
  return 0;
}
