#pragma once
#include "io/hdf5/convert.h"

namespace svnet::io::hdf5 {

/// Reads an open dataset in blocks of up to `most` values. What is stored in chunks is one block, because a chunk that
/// two blocks share would be decoded twice.
void read_dataset_blocks(const File&, hid_t dataset, const Extent&, const std::string& where, std::uint64_t most,
                         const TakeBlock& take);

}  // namespace svnet::io::hdf5
