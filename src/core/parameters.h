// SPDX-License-Identifier: MIT
// A parameter is declared once, in visit(); command line, sweep axes, result columns and docs follow from it.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace luxel {

struct Range {
    double least, most; // inclusive
};

// Called once per parameter, in declaration order.
class Visitor {
public:
    virtual ~Visitor() = default;
    virtual void real(std::string_view name, float& value, Range range, std::string_view meaning) = 0;
    virtual void integer(std::string_view name, int& value, Range range, std::string_view meaning) = 0;
    virtual void flag(std::string_view name, bool& value, std::string_view meaning) = 0;
    virtual void text(std::string_view name, std::string& value, std::string_view meaning) = 0;
    // value is an index into options
    virtual void choice_index(std::string_view name, int& value, const std::vector<std::string>& options,
                              std::string_view meaning) = 0;

    template <class Enum>
    void choice(std::string_view name, Enum& value, const std::vector<std::string>& options,
                std::string_view meaning) {
        int index = static_cast<int>(value);
        choice_index(name, index, options, meaning);
        value = static_cast<Enum>(index);
    }
};

// "name:key=value,key=value" as typed after --use.
struct Specification {
    std::string name;
    std::vector<std::pair<std::string, std::string>> values;
};
// Error Fault::usage with the reason.
Specification parse_specification(std::string_view text);

// One declared parameter, read through visit().
struct ParameterInfo {
    std::string name, type, value, allowed, meaning;
};

// Anything with `void visit(Visitor&)`.
// set_parameters: Error Fault::usage for an unknown name (the known ones are listed), a value that does not
// parse or lies outside its range.
// parameters_of: all parameters with their present values.
namespace detail {
using Visit = void (*)(void* object, Visitor& visitor);
void set(void* object, Visit visit, std::string_view owner,
         const std::vector<std::pair<std::string, std::string>>& values);
std::vector<ParameterInfo> list(void* object, Visit visit);
template <class T> void call(void* object, Visitor& visitor) { static_cast<T*>(object)->visit(visitor); }
} // namespace detail
template <class T>
void set_parameters(T& object, std::string_view owner,
                    const std::vector<std::pair<std::string, std::string>>& values) {
    detail::set(&object, detail::call<T>, owner, values);
}
template <class T> std::vector<ParameterInfo> parameters_of(T& object) {
    return detail::list(&object, detail::call<T>);
}

} // namespace luxel
