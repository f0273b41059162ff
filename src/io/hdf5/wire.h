#pragma once
#include "io/hdf5/request.h"
#include "sandbox/child.h"

// Requests and answers as messages between two processes.
namespace svnet::io::hdf5 {

/// Sends what is put into it to the parent.
class ChannelSink : public Sink {
 public:
  explicit ChannelSink(sandbox::Channel& channel) : channel_(channel) {}

  void truth(bool value) override;
  void shape(std::span<const std::uint64_t> shape) override;
  void texts(std::span<const std::string> texts) override;
  void values(std::span<const std::byte> bytes) override;
  std::span<std::byte> room() override { return channel_.room(); }

  /// One of them ends an answer.
  void end();
  void error(const std::string& text);

 private:
  sandbox::Channel& channel_;
};

/// The next request of the parent. Throws ChannelClosed if there will be none.
Request receive_request(sandbox::Channel&);

/// Asks the child and puts its answer into `to`. Returns the text of its error, or an empty one. Throws Error if the
/// child ended or breaks the protocol, and what `to` throws: after that the child cannot be asked again.
std::string ask(sandbox::Child&, const Request&, Sink& to);

}  // namespace svnet::io::hdf5
