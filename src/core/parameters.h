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

    template <class Enum> void choice(std::string_view name, Enum& value,
                                      const std::vector<std::string>& options, std::string_view meaning) {
        int index = static_cast<int>(value);
        choice_index(name, index, options, meaning);
        value = static_cast<Enum>(index);
    }

    // What `declare` declares has an effect only while `acts`; `when` says which setting that is
    // ("mode=thesis"). Conditions may be nested.
    template <class Declare> void only_if(bool acts, std::string_view when, Declare&& declare) {
        const Condition outer = condition_;
        condition_ = {outer.acts && acts,
                      outer.when.empty() ? std::string(when) : outer.when + " and " + std::string(when)};
        declare();
        condition_ = outer;
    }

protected:
    struct Condition {
        bool acts = true;
        std::string when;
    };
    const Condition& condition() const { return condition_; } // of what is declared now

private:
    Condition condition_;
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
    std::string when{}; // the settings without which it has no effect; "": it always has
    bool acts = true;   // under the present settings
};

// Anything with `void visit(Visitor&)`.
// set_parameters: Error Fault::usage for an unknown name (the known ones are listed), a value that does not
// parse or lies outside its range.
// parameters_of: all parameters with their present values.
// idle_parameters: a sentence for each of the values that was set and has no effect, by the settings that it
// would need.
namespace detail {
using Visit = void (*)(void* object, Visitor& visitor);
void set(void* object, Visit visit, std::string_view owner,
         const std::vector<std::pair<std::string, std::string>>& values);
std::vector<ParameterInfo> list(void* object, Visit visit);
std::vector<std::string> idle(void* object, Visit visit, std::string_view owner,
                              const std::vector<std::pair<std::string, std::string>>& values);
template <class T> void call(void* object, Visitor& visitor) { static_cast<T*>(object)->visit(visitor); }
} // namespace detail
template <class T> void set_parameters(T& object, std::string_view owner,
                                       const std::vector<std::pair<std::string, std::string>>& values) {
    detail::set(&object, detail::call<T>, owner, values);
}
template <class T> std::vector<ParameterInfo> parameters_of(T& object) {
    return detail::list(&object, detail::call<T>);
}
template <class T>
std::vector<std::string> idle_parameters(T& object, std::string_view owner,
                                         const std::vector<std::pair<std::string, std::string>>& values) {
    return detail::idle(&object, detail::call<T>, owner, values);
}

} // namespace luxel
