// A list that never changes and that its copies share.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace enfilade {

template <class T>
class SharedList {
 public:
  SharedList() = default;
  explicit SharedList(std::vector<T> items)
      : items_(std::make_shared<const std::vector<T>>(std::move(items))) {}

  std::size_t size() const { return items_ ? items_->size() : 0; }
  const T& operator[](std::size_t i) const { return (*items_)[i]; }
  std::span<const T> all() const {
    return items_ ? std::span<const T>(*items_) : std::span<const T>();
  }

 private:
  std::shared_ptr<const std::vector<T>> items_;
};

}  // namespace enfilade
