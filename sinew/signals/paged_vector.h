// signals/paged_vector.h - a vector that may be longer than memory: samples of hours.
//
// Its newest elements, at most a page, are in memory, the full pages before them in a PageFile.
// Without a file all elements stay in memory, as in a std::vector. Elements are added at the end
// and read anywhere. Sequential reading, in either direction, is as fast as in memory apart from
// one disk access per page. Values read have the bits that were written.
//
// Copies share their elements until one of them is changed, so copying is cheap. An object with
// pages in a file may be read by one thread at a time, since it caches the last page; each thread
// can use its own copy. Reading throws std::runtime_error if the disk fails.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "sinew/signals/page_file.h"

namespace sinew::signals {

template <class T>
class PagedVector {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= PageFile::page_bytes);

 public:
  using value_type = T;
  using size_type = std::size_t;
  static constexpr std::size_t page_size = PageFile::page_bytes / sizeof(T);  // elements

  class const_iterator;
  using iterator = const_iterator;

  PagedVector() = default;
  // Starts empty, with pages in that file; or with these values.
  explicit PagedVector(const PageFile& file) : store_(std::make_shared<Store>(file)) {}
  PagedVector(std::vector<T> values) : store_(std::make_shared<Store>(std::move(values))) {}
  PagedVector(std::initializer_list<T> values) : PagedVector(std::vector<T>(values)) {}
  template <std::input_iterator It>
  PagedVector(It first, It last, const PageFile& file = {}) : PagedVector(file) {
    for (; first != last; ++first) push_back(*first);
  }

  PagedVector(const PagedVector& other) : store_(other.store_) {}  // without the cached page
  // Leaves the other one empty.
  PagedVector(PagedVector&& other) noexcept { swap(other); }
  PagedVector& operator=(PagedVector other) noexcept {
    swap(other);
    return *this;
  }
  ~PagedVector() = default;

  // Exchanges the contents.
  void swap(PagedVector& other) noexcept {
    store_.swap(other.store_);
    cached_.swap(other.cached_);
    std::swap(cached_page_, other.cached_page_);
  }

  // Returns the file of its pages; empty if it stays in memory. Vectors derived from these
  // elements, of the same length, use the same file.
  PageFile file() const { return store_ ? store_->file : PageFile(); }

  std::size_t size() const { return store_ ? store_->paged() + store_->tail.size() : 0; }
  bool empty() const { return size() == 0; }
  T operator[](std::size_t i) const {
    const std::size_t paged = store_->paged();
    return i >= paged ? store_->tail[i - paged] : load_page(i / page_size)[i % page_size];
  }
  // Return the first and the last value; requires at least one.
  T front() const { return (*this)[0]; }
  T back() const { return (*this)[size() - 1]; }
  const_iterator begin() const { return {this, 0}; }
  const_iterator end() const { return {this, size()}; }
  std::vector<T> slice(std::size_t first, std::size_t last) const;  // in memory
  // Returns all values, in memory.
  std::vector<T> in_memory() const { return slice(0, size()); }

  // Appends a value. Throws std::runtime_error if its file has no more room.
  void push_back(T value) {
    detach();
    if (!store_->push(value)) fail(store_->file);
  }

  // For the loop: does not allocate after reserve(), and does not throw. Returns false, and adds
  // nothing, if the disk or the reserved room is full.
  bool try_push_back(T value) noexcept { return store_->room() && store_->push(value); }
  // Reserves room for this number of elements; with a file, for the list of their pages only.
  void reserve(std::size_t elements) {
    detach();
    store_->reserve(elements);
  }

  // Remove the last value; change one; remove all; hold n equal ones.
  void pop_back();
  void set(std::size_t i, T value);
  void clear() { *this = PagedVector(file()); }
  void assign(std::size_t n, T value) {
    clear();
    for (std::size_t i = 0; i < n; ++i) push_back(value);
  }

  friend bool operator==(const PagedVector& a, const PagedVector& b) {
    if (a.store_ == b.store_) return true;
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
  }

 private:
  struct Store {
    explicit Store(const PageFile& its) : file(its) {}
    explicit Store(std::vector<T> values) : tail(std::move(values)) {}
    ~Store() {
      for (const std::uint32_t page : pages) file.release(page);
    }
    Store(const Store&) = delete;
    Store& operator=(const Store&) = delete;

    std::size_t paged() const noexcept { return pages.size() * page_size; }
    bool room() const noexcept {
      const bool turns = file && tail.size() == page_size;
      return turns ? pages.size() < pages.capacity() : tail.size() < tail.capacity();
    }
    bool push(T value) {
      if (file && tail.size() == page_size) {
        const std::uint32_t page = file.write(tail.data(), page_size * sizeof(T));
        if (page == PageFile::no_page) return false;
        pages.push_back(page);
        tail.clear();
      }
      tail.push_back(value);
      return true;
    }
    void reserve(std::size_t elements) {
      tail.reserve(file ? std::min(elements, page_size) : elements);
      if (file) pages.reserve(elements / page_size + 1);
    }

    PageFile file;
    std::vector<std::uint32_t> pages;  // full pages
    std::vector<T> tail;               // elements after the pages
  };

  // Detaches from copies before a change.
  void detach() {
    if (!store_) store_ = std::make_shared<Store>(PageFile());
    if (store_.use_count() > 1) *this = PagedVector(begin(), end(), file());
  }
  const T* load_page(std::size_t page) const {
    if (page != cached_page_) {
      if (!cached_) cached_ = std::make_unique_for_overwrite<T[]>(page_size);
      cached_page_ = none;
      if (!store_->file.read(store_->pages[page], cached_.get(), page_size * sizeof(T)))
        fail(store_->file);
      cached_page_ = page;
    }
    return cached_.get();
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::shared_ptr<Store> store_;
  mutable std::unique_ptr<T[]> cached_;  // the page that was read last
  mutable std::size_t cached_page_ = none;
};

// Random access iterator over the values.
template <class T>
class PagedVector<T>::const_iterator {
 public:
  using iterator_category = std::random_access_iterator_tag;
  using value_type = T;
  using difference_type = std::ptrdiff_t;
  using pointer = const T*;
  using reference = T;

  const_iterator() = default;
  // Refers to the value at that index.
  const_iterator(const PagedVector* of, std::size_t at) : of_(of), at_(at) {}

  T operator*() const { return (*of_)[at_]; }
  T operator[](difference_type n) const { return *(*this + n); }
  const_iterator& operator+=(difference_type n) {
    at_ += static_cast<std::size_t>(n);
    return *this;
  }
  const_iterator& operator-=(difference_type n) { return *this += -n; }
  const_iterator& operator++() { return *this += 1; }
  const_iterator& operator--() { return *this += -1; }
  const_iterator operator++(int) { return std::exchange(*this, *this + 1); }
  const_iterator operator--(int) { return std::exchange(*this, *this - 1); }
  friend const_iterator operator+(const_iterator i, difference_type n) { return i += n; }
  friend const_iterator operator+(difference_type n, const_iterator i) { return i += n; }
  friend const_iterator operator-(const_iterator i, difference_type n) { return i -= n; }
  friend difference_type operator-(const const_iterator& a, const const_iterator& b) {
    return static_cast<difference_type>(a.at_) - static_cast<difference_type>(b.at_);
  }
  friend bool operator==(const const_iterator& a, const const_iterator& b) {
    return a.at_ == b.at_;
  }
  friend auto operator<=>(const const_iterator& a, const const_iterator& b) {
    return a.at_ <=> b.at_;
  }

 private:
  const PagedVector* of_ = nullptr;
  std::size_t at_ = 0;
};

template <class T>
std::vector<T> PagedVector<T>::slice(std::size_t first, std::size_t last) const {
  std::vector<T> out;
  out.reserve(last - first);
  for (std::size_t i = first; i < last; ++i) out.push_back((*this)[i]);
  return out;
}

template <class T>
void PagedVector<T>::pop_back() {
  detach();
  Store& s = *store_;
  if (s.tail.empty()) {  // the last page is read back
    const T* values = load_page(s.pages.size() - 1);
    s.tail.assign(values, values + page_size);
    s.file.release(s.pages.back());
    s.pages.pop_back();
    cached_page_ = none;
  }
  s.tail.pop_back();
}

template <class T>
void PagedVector<T>::set(std::size_t i, T value) {
  detach();
  Store& s = *store_;
  const std::size_t paged = s.paged();
  if (i >= paged) {
    s.tail[i - paged] = value;
    return;
  }
  const std::size_t page = i / page_size, at = i % page_size;
  if (!s.file.rewrite(s.pages[page], at * sizeof(T), &value, sizeof(T))) fail(s.file);
  if (page == cached_page_) cached_[at] = value;
}

}  // namespace sinew::signals
