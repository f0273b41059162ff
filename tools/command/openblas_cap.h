#pragma once

namespace svnet {

/// OpenBLAS, which multiplies the matrices of the training, chooses its kernels when it is loaded, by the processor or
/// by OPENBLAS_CORETYPE. Where SVNET_MAX_ISA is set and the latter is not, sets it to kernels that keep to the same
/// instruction set and starts the program again, before it has done anything. Returns where nothing is to be changed.
void cap_openblas_from_environment(char** argv);

}  // namespace svnet
