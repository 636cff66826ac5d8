// Values for some of the clusters: a value is found in constant time by the cluster's number, and
// for_each() visits the values in the order of the numbers.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "base/ids.hpp"

namespace enfilade {

template <class T>
class ClusterTable {
 public:
  T* find(ClusterId id) const {
    return id.index() < places_.size() ? places_[id.index()].get() : nullptr;
  }
  /// Makes a value where there is none.
  T& operator[](ClusterId id) {
    if (id.index() >= places_.size()) places_.resize(id.index() + 1);
    std::unique_ptr<T>& place = places_[id.index()];
    if (!place) place = std::make_unique<T>();
    return *place;
  }
  void erase(ClusterId id) {
    if (id.index() < places_.size()) places_[id.index()].reset();
  }
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i]) visit(ClusterId(i), *places_[i]);
    }
  }

 private:
  std::vector<std::unique_ptr<T>> places_;
};

}  // namespace enfilade
