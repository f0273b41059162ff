# svnet_highway: Highway with the instruction sets that kernels are compiled for. All files must agree on them.
#   AVX3    AVX-512 (F, BW, DQ, VL)
#   AVX2    with FMA
#   SSE4    128-bit vectors, for small processors without AVX
#   SCALAR  no vectors: the fallback of processors older than SSE4.1
# Disabled: SSSE3, whose processors are as old as those without it, and what is above AVX3 (bits 0 to 7: AVX3_DL and, in
# newer versions of Highway, AVX3_ZEN4 and AVX3_SPR): it adds no instruction that a kernel uses. bf16 tiles do not go
# through Highway (nn/kernels/packed/bf16_tile.h).
option(SVNET_ONLY_AVX2 "AVX2 and SCALAR alone: kernels compile in half the time; for builds that test other parts" OFF)
pkg_check_modules(Highway REQUIRED IMPORTED_TARGET libhwy)
add_library(svnet_highway INTERFACE)
target_link_libraries(svnet_highway INTERFACE PkgConfig::Highway)
set(disabled "HWY_SSSE3|0xff")
if(SVNET_ONLY_AVX2)
  string(APPEND disabled "|HWY_AVX3|HWY_SSE4")
endif()
target_compile_definitions(svnet_highway INTERFACE "HWY_DISABLED_TARGETS=(${disabled})")
