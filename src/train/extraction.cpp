#include "train/extraction.h"

#include <algorithm>
#include <exception>
#include <future>
#include <limits>
#include <map>
#include <mutex>
#include <optional>

#include "base/error.h"
#include "base/finite.h"

namespace svnet::train {
namespace {

struct Inputs {
  Index begin, end;
};

/// The rows, how far they are, and those who are told.
class Rows {
 public:
  /// `own`: the inputs that this process has to make.
  Rows(const Extraction& extraction, const Inputs& own, const Messages& messages)
      : e_(extraction),
        own_(own),
        rows_(static_cast<std::size_t>(e_.count * e_.dimension)),
        progress_(messages, "features of " + e_.network, std::max<Index>(own.end - own.begin, 0)) {
    std::ranges::copy(e_.made, rows_.begin());
  }

  /// Safe to call from several threads for different inputs.
  void store(const Inputs& inputs, const Tensor& values) {
    if (const auto bad = first_not_finite(values.values<float>()))
      fail("[", e_.network, "] a feature of ", e_.name(inputs.begin + static_cast<Index>(*bad) / e_.dimension),
           " is not finite: the weights do not fit this network");
    std::copy_n(values.data<float>(), values.size(), rows_.data() + inputs.begin * e_.dimension);
  }

  /// Tells that `done` of the process's own inputs have their rows, among them all before `end`. Throws what
  /// messages.progress throws.
  void report(Index done, Index end) {
    progress_.update(done);
    constexpr double kSeconds = 60;
    if (progress_.seconds() - kept_seconds_ > kSeconds && end < own_.end) {
      keep(end);
      kept_seconds_ = progress_.seconds();
    }
  }

  void keep(Index end) {
    if (e_.keep && end > 0) e_.keep(std::span(rows_).first(static_cast<std::size_t>(end * e_.dimension)));
  }

  std::vector<float>& values() { return rows_; }

 private:
  const Extraction& e_;
  Inputs own_;
  std::vector<float> rows_;
  Progress progress_;
  double kept_seconds_ = 0;
};

/// Hands out inputs in order to threads that each take a batch from its inputs to its rows, and knows which are done.
class Lanes {
 public:
  Lanes(const Inputs& all, Index batch, Index unit, int threads)
      : all_(all), batch_(batch), unit_(unit), threads_(threads), next_(all.begin), complete_(all.begin) {}

  /// The next batch, until there is none or something was thrown. At most half of the inputs that are left go to the
  /// next batch of each thread, so that all threads end at about the same time.
  std::optional<Inputs> take() {
    const std::lock_guard lock(mutex_);
    if (next_ >= all_.end || error_) return {};
    const Index fair = (all_.end - next_) / (2 * threads_) / unit_ * unit_;
    const Inputs taken{next_, std::min(next_ + std::clamp(fair, unit_, batch_), all_.end)};
    next_ = taken.end;
    return taken;
  }

  void finish(const Inputs& inputs) {
    const std::lock_guard lock(mutex_);
    done_ += inputs.end - inputs.begin;
    finished_[inputs.begin] = inputs.end;
    for (auto first = finished_.begin(); first != finished_.end() && first->first == complete_;
         first = finished_.erase(first))
      complete_ = first->second;
  }

  /// Keeps what was thrown for the first inputs. Earlier batches are with other threads by then, and get done.
  void fail(Index begin, const std::exception_ptr& error) {
    const std::lock_guard lock(mutex_);
    if (begin < failed_) failed_ = begin, error_ = error;
  }

  /// How many inputs are done, and before which all are.
  struct State {
    Index done, complete;
  };
  State state() {
    const std::lock_guard lock(mutex_);
    return {done_, complete_};
  }
  std::exception_ptr error() const { return error_; }

 private:
  const Inputs all_;
  const Index batch_, unit_, threads_;
  std::mutex mutex_{};
  Index next_, done_ = 0, complete_;
  std::map<Index, Index> finished_{};  // ends of batches that are done before an earlier one is, by their begins
  Index failed_ = std::numeric_limits<Index>::max();
  std::exception_ptr error_{};
};

void run_in_lanes(const Extraction& e, const Inputs& own, Index batch, Rows& rows) {
  Parallel& parallel = Parallel::shared();
  Lanes lanes(own, batch, e.unit, parallel.threads());
  bool was_stopped = false;
  Index reported = -1;
  // Parallel calls from inside the body run in its thread.
  parallel.for_chunks(parallel.threads(), 1, [&](Index, Index, int worker) {
    while (const auto inputs = lanes.take()) try {
        rows.store(*inputs, e.run(e.prepared(inputs->begin, inputs->end, parallel)));
        lanes.finish(*inputs);
        if (worker != 0) continue;  // the calling thread alone reports
        try {
          const Lanes::State state = lanes.state();
          reported = state.done;
          rows.report(state.done, state.complete);
        } catch (...) {
          was_stopped = true;
          lanes.fail(-1, std::current_exception());
        }
      } catch (...) {
        lanes.fail(inputs->begin, std::current_exception());
      }
  });
  const Lanes::State state = lanes.state();
  if (was_stopped) rows.keep(state.complete);
  if (lanes.error()) std::rethrow_exception(lanes.error());
  if (reported == state.done) return;
  try {
    rows.report(state.done, state.complete);
  } catch (...) {
    rows.keep(state.complete);
    throw;
  }
}

/// All threads run one batch. Others prepare the next one, unless there is one thread only.
void run_in_turns(const Extraction& e, const Inputs& own, Rows& rows) {
  // The network has the shared pool. The future comes last: it waits for what the readers still do.
  Parallel readers(Parallel::shared().threads());
  const auto launch = readers.threads() > 1 ? std::launch::async : std::launch::deferred;
  std::future<Tensor> next;
  const auto prepare_from = [&](Index begin) {
    next = std::async(launch, [&, begin] { return e.prepared(begin, std::min(begin + e.batch, own.end), readers); });
  };
  if (own.begin < own.end) prepare_from(own.begin);
  for (Index begin = own.begin; begin < own.end; begin += e.batch) {
    const Index end = std::min(begin + e.batch, own.end);
    const Tensor batch = next.get();
    if (end < own.end) prepare_from(end);
    rows.store({begin, end}, e.run(batch));
    try {
      rows.report(end - own.begin, end);
    } catch (...) {
      rows.keep(end);
      throw;
    }
  }
}

/// The most inputs in a batch of a lane; 0 if there should be no lanes.
Index lane_batch(const Extraction& e, Index inputs) {
  constexpr Index kBatches = 4;                    // of each thread, at least
  constexpr Index kMostFloats = Index{256} << 20;  // 1 GiB
  constexpr Index kLeastBatch = 4;
  const Index threads = Parallel::shared().threads();
  if (inputs < kBatches * threads * e.unit) return 0;
  Index batch = e.batch;
  while (threads > 1 && e.memory && e.memory(batch) * threads > kMostFloats) {
    batch = batch / 2 / e.unit * e.unit;
    if (batch < std::min(kLeastBatch, e.batch)) return 0;
  }
  return batch;
}

}  // namespace

std::vector<float> extracted(const Extraction& e, const Messages& messages, Communicator& communicator) {
  // Shares are whole batches, as they would be without a communicator.
  const Share share = share_of(communicator, 0, static_cast<std::uint64_t>((e.count + e.batch - 1) / e.batch));
  const Index made = static_cast<Index>(e.made.size()) / e.dimension;
  check((made == 0 && !e.keep) || communicator.size() == 1, "[features] several processes keep no rows");
  const Inputs own{std::max(static_cast<Index>(share.first) * e.batch, made),
                   std::min(e.count, static_cast<Index>(share.last) * e.batch)};
  Rows rows(e, own, messages);
  if (const Index batch = lane_batch(e, own.end - own.begin))
    run_in_lanes(e, own, batch, rows);
  else
    run_in_turns(e, own, rows);
  communicator.all_reduce(rows.values());
  return std::move(rows.values());
}

}  // namespace svnet::train
