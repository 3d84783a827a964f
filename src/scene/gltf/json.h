// SPDX-License-Identifier: MIT
// JSON of an untrusted file: nesting and size are limited before the text is parsed, and every value that is
// read knows where it stands, so that an error names the place.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>

#include "core/error.h"
#include "scene/printable.h"

namespace luxel::gltf {

inline constexpr int max_json_depth = 64;
inline constexpr std::uint64_t max_json_bytes = std::uint64_t(256) << 20;
inline constexpr std::uint64_t max_json_values = std::uint64_t(32) << 20;

// Error Fault::bad_input "name: JSON: ...".
std::shared_ptr<const nlohmann::json> parse_json(std::span<const std::uint8_t> text, const std::string& name);

// A value of the document or the absence of one. The document and the file's name outlive it.
class Value {
public:
    Value(const nlohmann::json* json, std::string place, const std::string* file)
        : json_(json), place_(std::move(place)), file_(file) {}

    explicit operator bool() const { return json_ != nullptr; }
    const std::string& place() const { return place_; }
    const std::string& file() const { return *file_; }

    // Member of an object, element of an array; absent when there is none (and when this is absent).
    Value operator[](const char* member) const;
    Value at(std::size_t index) const;
    std::size_t size() const; // of an array; 0 when absent
    bool is_text() const;

    // Errors when the value is absent (without a fallback) or of another kind.
    std::uint64_t integer() const;
    std::uint64_t integer(std::uint64_t fallback) const { return json_ ? integer() : fallback; }
    double real() const; // finite, also in single precision
    float number() const { return float(real()); }
    float number(float fallback) const { return json_ ? number() : fallback; }
    bool flag(bool fallback) const;
    const std::string& text() const;
    std::string text(const char* fallback) const { return json_ ? text() : std::string(fallback); }
    // Exactly out.size() of them; nothing happens when absent.
    void numbers(std::span<float> out) const;
    void numbers(std::span<double> out) const;
    template <int N> glm::vec<N, float> vec(glm::vec<N, float> fallback) const {
        numbers(std::span<float>(&fallback[0], std::size_t(N)));
        return fallback;
    }
    template <int N> glm::vec<N, double> dvec(glm::vec<N, double> fallback) const {
        numbers(std::span<double>(&fallback[0], std::size_t(N)));
        return fallback;
    }
    std::vector<std::string> members() const; // names of an object's members; none when absent

    // Integer below `count`: an index into `what`.
    std::size_t index(std::size_t count, const char* what) const;

    template <class... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> reason, Args&&... args) const {
        luxel::fail(Fault::bad_input, "{}: {}: {}", *file_, place_,
                    fmt::format(reason, std::forward<Args>(args)...));
    }

private:
    [[noreturn]] void fail_kind(const char* expected) const;

    const nlohmann::json* json_;
    std::string place_;
    const std::string* file_;
};

} // namespace luxel::gltf
