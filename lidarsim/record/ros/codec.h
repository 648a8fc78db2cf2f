// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "record/ros/messages.h"

// The bytes of ROS messages. ROS 1: members one after the other, little endian, a 32-bit length
// before strings and arrays of variable length (wiki.ros.org/msg). ROS 2: the same in CDR (OMG
// DDS-XTypes 1.3, section 7.4.1, "plain CDR version 1"): a header of four bytes says "little
// endian", numbers are aligned to their size, counted from the header's end, and strings end with a
// 0 that is included in their length.
namespace plotscan::record::ros {

enum class Version { ros1, ros2 };

static_assert(std::endian::native == std::endian::little, "messages are written little-endian");

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;
inline constexpr std::size_t kCdrHeader = 4;

template <class Value>
concept Number = std::integral<Value> || std::floating_point<Value> || std::is_enum_v<Value>;

class Encoder {
 public:
  explicit Encoder(Version version) : version_(version) {
    if (version == Version::ros2) bytes_.assign({'\0', '\1', '\0', '\0'});
  }

  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  void ros1_only(std::uint32_t value) {
    if (version_ == Version::ros1) put(value);
  }
  std::string take() { return std::move(bytes_); }

 private:
  template <Number Value>
  void put(Value value) {
    if (version_ == Version::ros2) {
      const std::size_t past = (bytes_.size() - kCdrHeader) % sizeof value;
      if (past != 0) bytes_.append(sizeof value - past, '\0');
    }
    append(&value, sizeof value);
  }
  void put(const Time& time) {
    put(static_cast<std::uint32_t>(time.ns / kSecond_ns));
    put(static_cast<std::uint32_t>(time.ns % kSecond_ns));
  }
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + (version_ == Version::ros2 ? 1 : 0)));
    bytes_ += text;
    if (version_ == Version::ros2) bytes_.push_back('\0');
  }
  template <class Element>
  void put(const std::vector<Element>& elements) {
    put(static_cast<std::uint32_t>(elements.size()));
    put_each(std::span(elements));
  }
  template <class Element, std::size_t count>
  void put(const std::array<Element, count>& elements) {
    put_each(std::span<const Element>(elements));
  }
  template <class Element>
  void put_each(std::span<const Element> elements) {
    if constexpr (sizeof(Element) == 1) {
      append(elements.data(), elements.size());
    } else {
      for (const Element& element : elements) put(element);
    }
  }
  template <class Message>
  requires requires(Message& m, Encoder& e) { Message::fields(m, e); }
  void put(const Message& message) { Message::fields(message, *this); }

  void append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }

  Version version_;
  std::string bytes_;
};

// Reads what an Encoder writes. Throws InputError when the bytes end too early, or state more
// elements than they can hold.
class Decoder {
 public:
  Decoder(Version version, std::span<const char> bytes) : version_(version), bytes_(bytes) {
    if (version == Version::ros1) return;
    if (bytes.size() < kCdrHeader || bytes[0] != 0 || bytes[1] != 1)
      throw InputError("a message is not in plain little-endian CDR");
    at_ = kCdrHeader;
  }

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  void ros1_only(std::uint32_t& value) {
    if (version_ == Version::ros1) get(value);
  }

 private:
  template <Number Value>
  void get(Value& value) {
    if (version_ == Version::ros2) {
      const std::size_t past = (at_ - kCdrHeader) % sizeof value;
      if (past != 0) skip(sizeof value - past);
    }
    if constexpr (std::same_as<Value, bool>) {
      value = *skip(1) != 0;
    } else {
      std::memcpy(&value, skip(sizeof value), sizeof value);
    }
  }
  void get(Time& time) {
    std::uint32_t seconds = 0;
    std::uint32_t nanoseconds = 0;
    get(seconds);
    get(nanoseconds);
    time.ns = seconds * kSecond_ns + nanoseconds;
  }
  void get(std::string& text) {
    std::uint32_t size = 0;
    get(size);
    const char* begin = skip(size);
    text.assign(begin, size > 0 && version_ == Version::ros2 ? size - 1 : size);
  }
  template <class Element>
  void get(std::vector<Element>& elements) {
    std::uint32_t count = 0;
    get(count);
    if (count > bytes_.size() - at_) fail();  // an element takes at least one byte
    if constexpr (sizeof(Element) == 1) {
      const char* begin = skip(count);
      elements.assign(begin, begin + count);
    } else {
      elements.clear();
      for (std::uint32_t i = 0; i < count; ++i) get(elements.emplace_back());
    }
  }
  template <class Element, std::size_t count>
  void get(std::array<Element, count>& elements) {
    for (Element& element : elements) get(element);
  }
  template <class Message>
  requires requires(Message& m, Decoder& d) { Message::fields(m, d); }
  void get(Message& message) { Message::fields(message, *this); }

  const char* skip(std::size_t size) {
    if (size > bytes_.size() - at_) fail();
    at_ += size;
    return bytes_.data() + at_ - size;
  }
  [[noreturn]] static void fail() { throw InputError("a message ends before its last member"); }

  Version version_;
  std::span<const char> bytes_;
  std::size_t at_ = 0;
};

template <class... Messages>
std::string encode(Version version, const Messages&... messages) {
  Encoder encoder(version);
  encoder(messages...);
  return encoder.take();
}

// Throws InputError as Decoder does.
template <class Message>
Message decode(Version version, std::span<const char> bytes) {
  Message message;
  Decoder decoder(version, bytes);
  decoder(message);
  return message;
}

}  // namespace plotscan::record::ros
