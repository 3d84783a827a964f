// SPDX-License-Identifier: MIT
#include "scene/gltf/accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace luxel::gltf {
namespace {

enum class Component : std::uint32_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126
};

std::uint64_t size_of(Component c) {
    switch (c) {
    case Component::int8:
    case Component::uint8:
        return 1;
    case Component::int16:
    case Component::uint16:
        return 2;
    default:
        return 4;
    }
}

Component component_of(const Value& value) {
    const std::uint64_t code = value.integer();
    if (code < 5120 || code > 5126 || code == 5124) value.fail("{} is not a component type", code);
    return Component(code);
}

constexpr int matrix_components = 16;

int components_of(const Value& value) {
    const std::string& type = value.text();
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    if (type == "MAT4") return matrix_components;
    value.fail("\"{}\" is none of SCALAR, VEC2 to VEC4 and MAT4", printable(type));
}

// Elements at a fixed stride. Invariant: (count - 1) * stride + size <= bytes.size().
struct Strided {
    std::span<const std::uint8_t> bytes;
    std::uint64_t count = 0, stride = 0;
};

Strided locate(Document& document, const Value& owner, std::uint64_t count, std::uint64_t element_size) {
    const Document::View view = document.buffer_view(owner["bufferView"]);
    const std::uint64_t stride = view.stride == 0 ? element_size : view.stride;
    const std::uint64_t offset = owner["byteOffset"].integer(0), size = view.bytes.size();
    if (stride < element_size || stride > 256)
        owner.fail("stride {} does not fit elements of {} bytes", stride, element_size);
    if (offset > size || size - offset < element_size || count - 1 > (size - offset - element_size) / stride)
        owner.fail("{} elements of {} bytes at offset {}, {} bytes apart, do not fit the view of {} bytes",
                   count, element_size, offset, stride, size);
    return {view.bytes.subspan(std::size_t(offset)), count, stride};
}

struct Accessor {
    Value json;
    Component component;
    int components;
    bool normalized;
    std::uint64_t count;
    Strided data; // data.count == 0: all zeros
};

Accessor describe(Document& document, const Value& reference, bool matrix = false) {
    const Value json = document.resolve("accessors", reference);
    if (matrix != (components_of(json["type"]) == matrix_components))
        json.fail("is {} instead of a {}", json["type"].text(), matrix ? "MAT4" : "vector");
    Accessor a{json,
               component_of(json["componentType"]),
               components_of(json["type"]),
               json["normalized"].flag(false),
               json["count"].integer(),
               {}};
    if (a.count == 0) json.fail("has no elements");
    if (a.count > UINT32_MAX) json.fail("count {} is too large", a.count);
    if (json["bufferView"])
        a.data = locate(document, json, a.count, size_of(a.component) * std::uint64_t(a.components));
    return a;
}

template <class T> T load(const std::uint8_t* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

template <class T> float to_float(T value, bool normalized) {
    if constexpr (std::is_floating_point_v<T>) return value;
    if (!normalized) return float(value);
    return std::max(float(value) / float(std::numeric_limits<T>::max()), -1.0f);
}

// Calls f(T{}) with the type that the component code stands for.
template <class F> void with_type(Component component, F&& f) {
    switch (component) {
    case Component::int8:
        return f(std::int8_t{});
    case Component::uint8:
        return f(std::uint8_t{});
    case Component::int16:
        return f(std::int16_t{});
    case Component::uint16:
        return f(std::uint16_t{});
    case Component::uint32:
        return f(std::uint32_t{});
    case Component::float32:
        return f(float{});
    }
}

template <class T, int N> void convert(const Strided& data, const Accessor& a,
                                       std::vector<glm::vec<N, float>>& out,
                                       const std::vector<std::uint32_t>* targets) {
    for (std::uint64_t i = 0; i < data.count; ++i) {
        const std::uint8_t* from = data.bytes.data() + i * data.stride;
        glm::vec<N, float>& to = out[targets ? (*targets)[std::size_t(i)] : std::size_t(i)];
        for (int c = 0; c < std::min(a.components, N); ++c)
            to[c] = to_float(load<T>(from + std::size_t(c) * sizeof(T)), a.normalized);
    }
}

// Sparse accessors replace some elements: strictly increasing indices, and as many values.
struct Sparse {
    std::vector<std::uint32_t> targets;
    Strided values;
};

Sparse read_sparse(Document& document, const Accessor& a) {
    const Value sparse = a.json["sparse"];
    const std::uint64_t count = sparse["count"].integer();
    if (count == 0 || count > a.count) sparse.fail("count {} is not within 1 to {}", count, a.count);
    const Value indices = sparse["indices"];
    const Component component = component_of(indices["componentType"]);
    const Strided data = locate(document, indices, count, size_of(component));
    document.charge(count, sizeof(std::uint32_t));

    Sparse result;
    result.targets.resize(std::size_t(count));
    with_type(component, [&](auto kind) {
        using T = decltype(kind);
        if constexpr (!std::is_unsigned_v<T>) indices.fail("sparse indices must be unsigned integers");
        for (std::uint64_t i = 0; i < count; ++i)
            result.targets[std::size_t(i)] = std::uint32_t(load<T>(data.bytes.data() + i * data.stride));
    });
    for (std::size_t i = 0; i < result.targets.size(); ++i)
        if (result.targets[i] >= a.count || (i > 0 && result.targets[i] <= result.targets[i - 1]))
            indices.fail("index {} is out of range or order", result.targets[i]);
    result.values =
        locate(document, sparse["values"], count, size_of(a.component) * std::uint64_t(a.components));
    return result;
}

template <int N> std::vector<glm::vec<N, float>> read_vectors(Document& document, const Value& reference,
                                                              bool allow_vec3_as_vec4) {
    const Accessor a = describe(document, reference);
    if (a.components != N && !(allow_vec3_as_vec4 && a.components == 3))
        a.json.fail("is a {} instead of a vector of {} components", a.json["type"].text(), N);
    if (a.component == Component::uint32) a.json.fail("32-bit integers cannot be vertex attributes");
    document.charge(a.count, sizeof(glm::vec<N, float>));

    glm::vec<N, float> initial(0.0f);
    if (a.components < N) initial[N - 1] = 1.0f;
    std::vector<glm::vec<N, float>> out(std::size_t(a.count), initial);
    with_type(a.component, [&](auto kind) { convert<decltype(kind), N>(a.data, a, out, nullptr); });
    if (a.json["sparse"]) {
        const Sparse sparse = read_sparse(document, a);
        with_type(a.component,
                  [&](auto kind) { convert<decltype(kind), N>(sparse.values, a, out, &sparse.targets); });
    }
    return out;
}

} // namespace

std::uint64_t accessor_count(const Document& document, const Value& reference) {
    return document.resolve("accessors", reference)["count"].integer();
}

std::vector<glm::vec2> read_vec2(Document& document, const Value& reference) {
    return read_vectors<2>(document, reference, false);
}
std::vector<glm::vec3> read_vec3(Document& document, const Value& reference) {
    return read_vectors<3>(document, reference, false);
}
std::vector<glm::vec4> read_vec4(Document& document, const Value& reference, bool allow_vec3_as_vec4) {
    return read_vectors<4>(document, reference, allow_vec3_as_vec4);
}

std::vector<glm::mat4> read_mat4(Document& document, const Value& reference) {
    const Accessor a = describe(document, reference, true);
    if (a.component != Component::float32) a.json.fail("is not made of floats");
    document.charge(a.count, sizeof(glm::mat4));
    std::vector<glm::mat4> out(std::size_t(a.count), glm::mat4(0.0f));
    const auto copy = [&out](const Strided& data, const std::vector<std::uint32_t>* targets) {
        for (std::size_t i = 0; i < data.count; ++i)
            out[targets ? (*targets)[i] : i] = load<glm::mat4>(data.bytes.data() + i * data.stride);
    };
    copy(a.data, nullptr);
    if (!a.json["sparse"]) return out;
    const Sparse sparse = read_sparse(document, a);
    copy(sparse.values, &sparse.targets);
    return out;
}

std::vector<std::uint32_t> read_indices(Document& document, const Value& reference) {
    const Accessor a = describe(document, reference);
    if (a.components != 1 || a.normalized) a.json.fail("indices must be plain scalars");
    document.charge(a.count, sizeof(std::uint32_t));
    std::vector<std::uint32_t> out(std::size_t(a.count), 0u);
    const auto convert_to = [&](const Strided& data, const std::vector<std::uint32_t>* targets) {
        with_type(a.component, [&](auto kind) {
            using T = decltype(kind);
            if constexpr (!std::is_unsigned_v<T>) a.json.fail("indices must be unsigned integers");
            for (std::uint64_t i = 0; i < data.count; ++i)
                out[targets ? (*targets)[std::size_t(i)] : std::size_t(i)] =
                    std::uint32_t(load<T>(data.bytes.data() + i * data.stride));
        });
    };
    convert_to(a.data, nullptr);
    if (a.json["sparse"]) {
        const Sparse sparse = read_sparse(document, a);
        convert_to(sparse.values, &sparse.targets);
    }
    return out;
}

} // namespace luxel::gltf
