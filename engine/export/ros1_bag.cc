#include <cstdint>

#include "engine/export/formats.h"
#include "engine/export/patch_messages.h"
#include "engine/export/text.h"

namespace patchlab {
namespace {

// The records of the container, version 2.0, by their codes.
enum BagRecord : std::uint8_t {
  message_data = 2,
  bag_header = 3,
  index_data = 4,
  chunk = 5,
  chunk_info = 6,
  connection = 7
};

constexpr std::string_view magic = "#ROSBAG V2.0\n";
constexpr std::size_t header_record_size = 4096;
constexpr std::uint64_t message_time = 1;  // one second: seconds first, then nanoseconds

template <class T>
std::string raw(const T& value) {
  std::string bytes;
  append_bytes(bytes, value);
  return bytes;
}

std::string sized(const std::string& bytes) { return raw(static_cast<std::uint32_t>(bytes.size())) + bytes; }

std::string bag_field(const std::string& name, const std::string& value) { return sized(name + "=" + value); }

std::string bag_record(BagRecord kind, const std::string& fields, const std::string& data) {
  return sized(fields + bag_field("op", raw(static_cast<std::uint8_t>(kind)))) + sized(data);
}

std::string connection_record(std::uint32_t number, const RosMessage& message) {
  const std::string type(message.type);
  return bag_record(connection, bag_field("conn", raw(number)) + bag_field("topic", message.topic),
                    bag_field("topic", message.topic) + bag_field("type", type) +
                        bag_field("md5sum", std::string(ros1_md5(type))) +
                        bag_field("message_definition", ros1_definition(type)));
}

// One chunk that holds every connection with its one message, and where each lies.
struct Chunk {
  std::string data, index, connections, counts;
  std::uint32_t count = 0;

  void add(const RosMessage& message) {
    const std::string introduction = connection_record(count, message);
    connections += introduction;
    data += introduction;
    const auto offset = static_cast<std::uint32_t>(data.size());
    data += bag_record(message_data, bag_field("conn", raw(count)) + bag_field("time", raw(message_time)),
                       ros1_bytes(message));
    index += bag_record(index_data,
                        bag_field("ver", raw(std::uint32_t{1})) + bag_field("conn", raw(count)) +
                            bag_field("count", raw(std::uint32_t{1})),
                        raw(message_time) + raw(offset));
    counts += raw(count) + raw(std::uint32_t{1});
    ++count;
  }
};

std::string header_record(std::uint64_t index_at, std::uint32_t connections) {
  const std::string fields = bag_field("index_pos", raw(index_at)) +
                             bag_field("conn_count", raw(connections)) +
                             bag_field("chunk_count", raw(std::uint32_t{1}));
  const std::size_t used = bag_record(bag_header, fields, "").size();
  return bag_record(bag_header, fields, std::string(header_record_size - used, ' '));
}

std::string bag_bytes(const Chunk& all) {
  const std::uint64_t chunk_at = magic.size() + header_record_size;
  const std::string middle =
      bag_record(chunk,
                 bag_field("compression", "none") +
                     bag_field("size", raw(static_cast<std::uint32_t>(all.data.size()))),
                 all.data) +
      all.index;
  const std::string info =
      bag_record(chunk_info,
                 bag_field("ver", raw(std::uint32_t{1})) + bag_field("chunk_pos", raw(chunk_at)) +
                     bag_field("start_time", raw(message_time)) + bag_field("end_time", raw(message_time)) +
                     bag_field("count", raw(all.count)),
                 all.counts);
  return std::string(magic) + header_record(chunk_at + middle.size(), all.count) + middle + all.connections +
         info;
}

}  // namespace

Result<Exported> export_ros1_bag(const PatchSet& set, const ExportOptions& options) {
  Result<PatchMessages> messages = patch_messages(set, options.measured, 24);
  if (!messages) return messages.error();
  Chunk all;
  all.add(all_markers(*messages));
  for (const RosMessage& message : messages->poses) all.add(message);
  for (const RosMessage& message : messages->points) all.add(message);
  return Exported{{{"", bag_bytes(all)}}, std::move(messages->notices)};
}

}  // namespace patchlab
