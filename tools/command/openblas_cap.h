#pragma once

namespace svnet {

/// Makes OpenBLAS respect SVNET_MAX_ISA. OpenBLAS chooses its kernels when it is loaded: by OPENBLAS_CORETYPE, or else
/// by the processor. If SVNET_MAX_ISA is set and OPENBLAS_CORETYPE is not, this function sets OPENBLAS_CORETYPE and
/// starts the program again. Otherwise it returns. Requires: the program has done nothing yet.
void cap_openblas_from_environment(char** argv);

}  // namespace svnet
