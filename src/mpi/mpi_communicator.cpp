#include "mpi/mpi_communicator.h"

#define OMPI_SKIP_MPICXX 1  // leaves out the deprecated C++ interface
#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>

#include <mpi.h>

#include "base/environment.h"
#include "base/error.h"

namespace svnet {
namespace {

using namespace std::string_view_literals;

/// An error of MPI ends all processes (MPI_ERRORS_ARE_FATAL, the default).
class MpiCommunicator : public Communicator {
 public:
  MpiCommunicator() {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    check(provided >= MPI_THREAD_FUNNELED,
          "[mpi] this MPI does not support threads (MPI_THREAD_FUNNELED); use another build of MPI");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiCommunicator() override { MPI_Finalize(); }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void all_reduce(std::span<std::uint64_t> values) override { sum(values, MPI_UINT64_T); }
  /// Sums the bits as integers, so that -0 and NaN keep theirs.
  void all_reduce(std::span<float> values) override {
    static_assert(sizeof(float) == sizeof(std::uint32_t));
    sum(values, MPI_UINT32_T);
  }
  std::uint64_t broadcast(std::uint64_t value) override {
    MPI_Bcast(&value, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    return value;
  }
  void barrier() override { MPI_Barrier(MPI_COMM_WORLD); }

 private:
  template <class T>
  static void sum(std::span<T> values, MPI_Datatype type) {
    constexpr std::size_t kMost = std::size_t{1} << 28;  // elements per call: MPI counts are ints
    for (std::size_t first = 0; first < values.size(); first += kMost)
      MPI_Allreduce(MPI_IN_PLACE, values.data() + first, std::min(kMost, values.size() - first), type, MPI_SUM,
                    MPI_COMM_WORLD);
  }

  int rank_ = 0, size_ = 1;
};

/// "Open MPI v4.1.4" of the library's longer text.
std::string library_name() {
  std::string text(MPI_MAX_LIBRARY_VERSION_STRING, '\0');
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  return text.substr(0, std::min(text.find_first_of(",\n\0"sv), static_cast<std::size_t>(length)));
}

}  // namespace

int main_with_communicator(int argc, char** argv, const char* name,
                           int (*run)(int argc, char** argv, Communicator& communicator)) {
  if (!started_by_launcher()) {
    SingleProcess single_process;
    return run(argc, argv, single_process);
  }
  MpiCommunicator communicator;
  if (const int launched = launched_processes(); communicator.size() == 1 && launched > 1) {
    std::cerr
        << name << ": its launcher says that it started " << launched << " processes, but " << library_name()
        << ", which this was built with, sees one, so that each would do the whole work; start it by the mpirun of "
           "that MPI, or as one process"
        << std::endl;
    return 1;
  }
  const int status = run(argc, argv, communicator);
  if (status != 0 && communicator.size() > 1) MPI_Abort(MPI_COMM_WORLD, status);
  return status;
}

}  // namespace svnet
