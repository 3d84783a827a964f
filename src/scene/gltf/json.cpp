// SPDX-License-Identifier: MIT
#include "scene/gltf/json.h"

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace luxel::gltf {
namespace {

using Json = nlohmann::json;

// First pass: builds nothing, only refuses what would exhaust the stack or the memory of the second pass.
class Limits : public nlohmann::json_sax<Json> {
public:
    explicit Limits(const std::string& name) : name_(name) {}

    bool null() override { return count(); }
    bool boolean(bool) override { return count(); }
    bool number_integer(number_integer_t) override { return count(); }
    bool number_unsigned(number_unsigned_t) override { return count(); }
    bool number_float(number_float_t, const string_t&) override { return count(); }
    bool string(string_t&) override { return count(); }
    bool binary(binary_t&) override { return count(); }
    bool key(string_t&) override { return true; }
    bool start_object(std::size_t) override { return enter(); }
    bool end_object() override { return leave(); }
    bool start_array(std::size_t) override { return enter(); }
    bool end_array() override { return leave(); }
    bool parse_error(std::size_t position, const std::string&, const Json::exception&) override {
        fail(Fault::bad_input, "{}: JSON: not valid at byte {}", name_, position);
    }

private:
    bool count() {
        if (++values_ > max_json_values)
            fail(Fault::bad_input, "{}: JSON: more than {} values", name_, max_json_values);
        return true;
    }
    bool enter() {
        if (++depth_ > max_json_depth)
            fail(Fault::bad_input, "{}: JSON: nested more than {} levels deep", name_, max_json_depth);
        return count();
    }
    bool leave() {
        --depth_;
        return true;
    }

    const std::string& name_;
    std::uint64_t values_ = 0;
    int depth_ = 0;
};

} // namespace

std::shared_ptr<const nlohmann::json> parse_json(std::span<const std::uint8_t> text,
                                                 const std::string& name) {
    if (text.empty()) fail(Fault::bad_input, "{}: JSON: the text is empty", name);
    if (text.size() > max_json_bytes)
        fail(Fault::bad_input, "{}: JSON: larger than {} bytes", name, max_json_bytes);
    Limits limits(name);
    Json::sax_parse(text.begin(), text.end(), &limits);
    auto json = std::make_shared<Json>(Json::parse(text.begin(), text.end()));
    if (!json->is_object()) fail(Fault::bad_input, "{}: JSON: the root is not an object", name);
    return json;
}

Value Value::operator[](const char* member) const {
    if (!json_) return {nullptr, place_ + '.' + member, file_};
    if (!json_->is_object()) fail_kind("an object");
    const auto found = json_->find(member);
    const bool present = found != json_->end() && !found->is_null();
    return {present ? &*found : nullptr, place_.empty() ? member : place_ + '.' + member, file_};
}

Value Value::at(std::size_t index) const {
    const bool present = index < size();
    return {present ? &(*json_)[index] : nullptr, fmt::format("{}[{}]", place_, index), file_};
}

std::size_t Value::size() const {
    if (!json_) return 0;
    if (!json_->is_array()) fail_kind("an array");
    return json_->size();
}

bool Value::is_text() const { return json_ && json_->is_string(); }

void Value::fail_kind(const char* expected) const {
    if (!json_) fail("is missing, expected {}", expected);
    fail("is not {}", expected);
}

std::uint64_t Value::integer() const {
    if (json_ && json_->is_number_unsigned()) return json_->get<std::uint64_t>();
    // JSON has one kind of number: 3.0 is an integer too, as far as doubles hold integers exactly.
    if (json_ && json_->is_number_float()) {
        const double value = json_->get<double>();
        if (value >= 0 && value <= 9007199254740992.0 && value == std::floor(value))
            return std::uint64_t(value);
    }
    fail_kind("a non-negative integer");
}

double Value::real() const {
    if (!json_ || !json_->is_number()) fail_kind("a number");
    const double value = json_->get<double>();
    if (!(std::abs(value) <= double(std::numeric_limits<float>::max()))) fail("is too large a number");
    return value;
}

bool Value::flag(bool fallback) const {
    if (!json_) return fallback;
    if (!json_->is_boolean()) fail_kind("true or false");
    return json_->get<bool>();
}

const std::string& Value::text() const {
    if (!json_ || !json_->is_string()) fail_kind("a string");
    return json_->get_ref<const std::string&>();
}

void Value::numbers(std::span<double> out) const {
    if (!json_) return;
    if (size() != out.size()) fail("has {} elements instead of {}", size(), out.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = at(i).real();
}

void Value::numbers(std::span<float> out) const {
    if (!json_) return;
    std::vector<double> values(out.size());
    numbers(std::span<double>(values));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = float(values[i]);
}

std::vector<std::string> Value::members() const {
    std::vector<std::string> names;
    if (!json_) return names;
    if (!json_->is_object()) fail_kind("an object");
    for (const auto& [name, value] : json_->items()) names.push_back(name);
    return names;
}

std::size_t Value::index(std::size_t count, const char* what) const {
    const std::uint64_t value = integer();
    if (value >= count) fail("{} {} does not exist (the file has {})", what, value, count);
    return std::size_t(value);
}

} // namespace luxel::gltf
