// Typed indices. Nodes, edges, half-edges, faces and stops are numbered from 0; an index of one kind cannot
// be used for another, and a `Per<I, T>` can be indexed by an `I` only. Neither costs time or memory beyond
// an int and a std::vector.
//
//     Per<NodeIndex, double> height(graph.node_count(), 0.0);
//     height[graph.origin(half_edge)] = 1;   // height[half_edge] does not compile
//
// This header must also compile as C++17 (see matching.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace unicursal::core {

/// The number of one thing of the kind `Tag`. A default index is invalid: it refers to nothing.
template <typename Tag>
class Index {
 public:
  constexpr Index() = default;
  constexpr explicit Index(std::size_t number) : number_(static_cast<std::int32_t>(number)) {}

  constexpr bool valid() const { return number_ >= 0; }
  /// Precondition: valid.
  constexpr std::size_t number() const { return static_cast<std::size_t>(number_); }

  constexpr Index& operator++() {
    ++number_;
    return *this;
  }
  friend constexpr bool operator==(Index a, Index b) { return a.number_ == b.number_; }
  friend constexpr bool operator!=(Index a, Index b) { return a.number_ != b.number_; }
  friend constexpr bool operator<(Index a, Index b) { return a.number_ < b.number_; }

 private:
  std::int32_t number_ = -1;
};

/// The indices 0 … count − 1, to be used in a range-based for loop.
template <typename I>
class IndexRange {
 public:
  class Iterator {
   public:
    constexpr explicit Iterator(I index) : index_(index) {}
    constexpr I operator*() const { return index_; }
    constexpr Iterator& operator++() {
      ++index_;
      return *this;
    }
    friend constexpr bool operator!=(Iterator a, Iterator b) { return a.index_ != b.index_; }

   private:
    I index_;
  };

  constexpr explicit IndexRange(std::size_t count) : count_(count) {}
  constexpr Iterator begin() const { return Iterator(I(0)); }
  constexpr Iterator end() const { return Iterator(I(count_)); }

 private:
  std::size_t count_;
};

/// One value for each index of a kind: a vector that only an `I` can index.
template <typename I, typename T>
class Per {
 public:
  Per() = default;
  explicit Per(std::size_t count, const T& value = T()) : values_(count, value) {}
  Per(std::initializer_list<T> values) : values_(values) {}

  decltype(auto) operator[](I index) { return values_[index.number()]; }
  decltype(auto) operator[](I index) const { return values_[index.number()]; }

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  IndexRange<I> indices() const { return IndexRange<I>(values_.size()); }

  /// Returns the index of the new value.
  I push_back(T value) {
    values_.push_back(std::move(value));
    return I(values_.size() - 1);
  }
  void pop_back() { values_.pop_back(); }
  void reserve(std::size_t count) { values_.reserve(count); }
  void resize(std::size_t count) { values_.resize(count); }
  void assign(std::size_t count, const T& value) { values_.assign(count, value); }

  /// The first index whose value satisfies `condition`; invalid if there is none.
  template <typename Condition>
  I first_with(Condition condition) const {
    for (std::size_t k = 0; k < values_.size(); ++k) {
      if (condition(values_[k])) return I(k);
    }
    return I();
  }

  const std::vector<T>& values() const { return values_; }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

  friend bool operator==(const Per& a, const Per& b) { return a.values_ == b.values_; }

 private:
  std::vector<T> values_;
};

// The kinds of a planar graph (planar_graph.hpp).
using NodeIndex = Index<struct NodeTag>;
using EdgeIndex = Index<struct EdgeTag>;
using HalfEdgeIndex = Index<struct HalfEdgeTag>;
using FaceIndex = Index<struct FaceTag>;

}  // namespace unicursal::core
