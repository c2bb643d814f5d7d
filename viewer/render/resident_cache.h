// What of shared arrays is on the GPU: made when an array is first drawn, dropped when nobody holds the array
// any more.
#pragma once

#include <memory>
#include <unordered_map>

namespace patchlab::viewer {

template <class Resident>
class ResidentCache {
 public:
  // `make` turns the array into a Resident. The reference is good until the next call.
  template <class Array, class Make>
  const Resident& get(const std::shared_ptr<const Array>& array, Make make) {
    const auto found = entries_.find(array.get());
    if (found != entries_.end() && found->second.array.lock() == array) return found->second.resident;
    return entries_.insert_or_assign(array.get(), Entry{array, make(*array)}).first->second.resident;
  }
  void drop_unheld() {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.array.expired(); });
  }
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::weak_ptr<const void> array;
    Resident resident;
  };
  std::unordered_map<const void*, Entry> entries_;
};

}  // namespace patchlab::viewer
