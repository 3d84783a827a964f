// SPDX-License-Identifier: MIT
// One pass over the module collects ids, a second one over its variables makes bindings of them.
#include "gpu/reflection.h"

#include <algorithm>
#include <unordered_map>

#include <spirv/unified1/spirv.hpp>

#include "core/error.h"

namespace luxel::gpu {
namespace {

struct Member {
    std::uint32_t offset = 0, matrix_stride = 0;
    bool non_readable = false, non_writable = false;
};

// Whatever an id may be; only a few fields are meant for each kind.
struct Id {
    spv::Op op = spv::OpNop;
    std::string name;
    std::vector<std::uint32_t> operands; // after the result id
    std::uint32_t type = 0;
    spv::StorageClass storage = spv::StorageClassMax;
    std::uint32_t set = 0, binding = 0, array_stride = 0, location = 0;
    bool non_readable = false, non_writable = false, block = false, builtin = false, used = false;
    std::vector<Member> members;
};

class Module {
public:
    Module(std::span<const std::uint32_t> words, const std::string& name) : name_(name) {
        LUXEL_ASSERT(words.size() > 5 && words[0] == spv::MagicNumber, "{} is not SPIR-V", name);
        for (std::size_t at = 5; at < words.size();) {
            const std::uint32_t length = words[at] >> 16;
            LUXEL_ASSERT(length > 0 && at + length <= words.size(), "{}: SPIR-V ends early", name);
            read(spv::Op(words[at] & 0xffffu), words.subspan(at + 1, length - 1));
            at += length;
        }
    }

    Reflection reflection() const {
        Reflection r = head_;
        for (std::size_t i = 0; i < local_size_ids_.size(); ++i)
            r.local_size[i] = ids_.at(local_size_ids_[i]).operands.at(0);
        for (const auto& [id, variable] : ids_) {
            if (variable.op != spv::OpVariable) continue;
            if (variable.storage == spv::StorageClassOutput && r.stage == VK_SHADER_STAGE_FRAGMENT_BIT &&
                !variable.builtin)
                r.color_outputs = std::max(r.color_outputs, variable.location + 1);
            if (variable.storage == spv::StorageClassUniform ||
                variable.storage == spv::StorageClassStorageBuffer ||
                variable.storage == spv::StorageClassUniformConstant)
                r.bindings.push_back(binding(variable));
        }
        std::sort(r.bindings.begin(), r.bindings.end(), [](const auto& a, const auto& b) {
            return std::pair(a.set, a.binding) < std::pair(b.set, b.binding);
        });
        return r;
    }

private:
    using Operands = std::span<const std::uint32_t>;

    static std::string text(Operands words) {
        const char* begin = reinterpret_cast<const char*>(words.data());
        return {begin, std::find(begin, begin + words.size() * 4, '\0')};
    }

    Member& member(std::uint32_t type, std::uint32_t index) {
        auto& members = ids_[type].members;
        if (members.size() <= index) members.resize(index + 1);
        return members[index];
    }

    void read(spv::Op op, Operands w) {
        switch (op) {
        case spv::OpName:
            ids_[w[0]].name = text(w.subspan(1));
            break;
        case spv::OpEntryPoint:
            read_entry_point(spv::ExecutionModel(w[0]));
            break;
        case spv::OpExecutionMode:
            if (w[1] == spv::ExecutionModeLocalSize) head_.local_size = {w[2], w[3], w[4]};
            break;
        case spv::OpExecutionModeId: // the constants follow later
            if (w[1] == spv::ExecutionModeLocalSizeId) local_size_ids_.assign(w.begin() + 2, w.end());
            break;
        case spv::OpDecorate:
            read_decoration(ids_[w[0]], spv::Decoration(w[1]), w.subspan(2));
            break;
        case spv::OpMemberDecorate:
            read_member(member(w[0], w[1]), spv::Decoration(w[2]), w.subspan(3));
            break;
        case spv::OpTypeBool:
        case spv::OpTypeInt:
        case spv::OpTypeFloat:
        case spv::OpTypeVector:
        case spv::OpTypeMatrix:
        case spv::OpTypeImage:
        case spv::OpTypeSampler:
        case spv::OpTypeSampledImage:
        case spv::OpTypeArray:
        case spv::OpTypeRuntimeArray:
        case spv::OpTypeStruct:
        case spv::OpTypePointer: {
            Id& id = ids_[w[0]];
            id.op = op;
            id.operands.assign(w.begin() + 1, w.end());
            break;
        }
        case spv::OpConstant:
        case spv::OpSpecConstant: // its default
        case spv::OpVariable: {
            Id& id = ids_[w[1]];
            id.op = op;
            id.type = w[0];
            id.operands.assign(w.begin() + 2, w.end());
            if (op == spv::OpVariable) id.storage = spv::StorageClass(w[2]);
            break;
        }
        // Every way in which a function can touch a variable.
        case spv::OpLoad:
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain:
        case spv::OpImageTexelPointer:
        case spv::OpArrayLength:
        case spv::OpCopyObject:
            ids_[w[2]].used = true;
            break;
        case spv::OpStore:
            ids_[w[0]].used = true;
            break;
        case spv::OpCopyMemory:
            ids_[w[0]].used = ids_[w[1]].used = true;
            break;
        case spv::OpFunctionCall:
            for (const std::uint32_t argument : w.subspan(3)) ids_[argument].used = true;
            break;
        default:
            break;
        }
    }

    void read_entry_point(spv::ExecutionModel model) {
        switch (model) {
        case spv::ExecutionModelGLCompute:
            head_.stage = VK_SHADER_STAGE_COMPUTE_BIT;
            break;
        case spv::ExecutionModelVertex:
            head_.stage = VK_SHADER_STAGE_VERTEX_BIT;
            break;
        case spv::ExecutionModelFragment:
            head_.stage = VK_SHADER_STAGE_FRAGMENT_BIT;
            break;
        default:
            LUXEL_ASSERT(false, "{}: execution model {} is not supported", name_, int(model));
        }
    }

    static void read_decoration(Id& id, spv::Decoration decoration, Operands w) {
        switch (decoration) {
        case spv::DecorationDescriptorSet:
            id.set = w[0];
            break;
        case spv::DecorationBinding:
            id.binding = w[0];
            break;
        case spv::DecorationLocation:
            id.location = w[0];
            break;
        case spv::DecorationArrayStride:
            id.array_stride = w[0];
            break;
        case spv::DecorationBlock:
            id.block = true;
            break;
        case spv::DecorationBuiltIn:
            id.builtin = true;
            break;
        case spv::DecorationNonReadable:
            id.non_readable = true;
            break;
        case spv::DecorationNonWritable:
            id.non_writable = true;
            break;
        default:
            break;
        }
    }

    static void read_member(Member& m, spv::Decoration decoration, Operands w) {
        switch (decoration) {
        case spv::DecorationOffset:
            m.offset = w[0];
            break;
        case spv::DecorationMatrixStride:
            m.matrix_stride = w[0];
            break;
        case spv::DecorationNonReadable:
            m.non_readable = true;
            break;
        case spv::DecorationNonWritable:
            m.non_writable = true;
            break;
        default:
            break;
        }
    }

    // Bytes in a block; a runtime array has none.
    std::uint64_t size_of(std::uint32_t type_id, std::uint32_t matrix_stride) const {
        const Id& t = ids_.at(type_id);
        switch (t.op) {
        case spv::OpTypeInt:
        case spv::OpTypeFloat:
            return t.operands[0] / 8;
        case spv::OpTypeVector:
            return size_of(t.operands[0], 0) * t.operands[1];
        case spv::OpTypeMatrix: // columns are a stride apart; the last one is not padded
            return std::uint64_t(matrix_stride) * (t.operands[1] - 1) + size_of(t.operands[0], 0);
        case spv::OpTypeArray: {
            const std::uint64_t count = ids_.at(t.operands[1]).operands[0];
            return t.array_stride * count;
        }
        case spv::OpTypeStruct: {
            std::uint64_t end = 0;
            for (std::size_t i = 0; i < t.operands.size(); ++i) {
                const Member& m = t.members[i];
                end = std::max(end, m.offset + size_of(t.operands[i], m.matrix_stride));
            }
            return end;
        }
        default:
            return 0;
        }
    }

    ShaderBinding binding(const Id& variable) const {
        const Id* type = &ids_.at(ids_.at(variable.type).operands[1]);
        ShaderBinding b{
            .name = variable.name, .set = variable.set, .binding = variable.binding, .used = variable.used};
        LUXEL_ASSERT(type->op != spv::OpTypeArray && type->op != spv::OpTypeRuntimeArray,
                     "{}: {} is an array of descriptors; use an array image or a buffer", name_,
                     variable.name);

        if (type->op == spv::OpTypeStruct) {
            // A buffer is readonly when all its members are (or the variable itself, in newer compilers).
            const bool storage = variable.storage == spv::StorageClassStorageBuffer;
            const auto& m = type->members;
            const auto every = [&](bool Member::*flag) {
                return !m.empty() &&
                       std::all_of(m.begin(), m.end(), [&](const Member& x) { return x.*flag; });
            };
            b.type = storage ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
            b.block = type->name;
            b.reads = !(variable.non_readable || every(&Member::non_readable));
            b.writes = storage && !(variable.non_writable || every(&Member::non_writable));
            if (!storage) b.block_size = size_of(ids_.at(variable.type).operands[1], 0);
            return b;
        }

        const bool combined = type->op == spv::OpTypeSampledImage;
        if (combined) type = &ids_.at(type->operands[0]);
        LUXEL_ASSERT(type->op == spv::OpTypeImage, "{}: {} is neither a buffer nor a combined image", name_,
                     variable.name);
        describe_image(b, *type, variable);
        return b;
    }

    // Operands of OpTypeImage: sampled type, dim, depth, arrayed, multisampled, sampled, format.
    void describe_image(ShaderBinding& b, const Id& image, const Id& variable) const {
        const Id& number = ids_.at(image.operands[0]);
        if (number.op == spv::OpTypeInt) b.numbers = number.operands[1] ? Numbers::int_ : Numbers::uint_;
        const auto dim = spv::Dim(image.operands[1]);
        const bool arrayed = image.operands[3] != 0, storage = image.operands[5] == 2;
        if (dim == spv::DimBuffer) {
            LUXEL_ASSERT(!storage, "{}: {} is a storage texel buffer; use a storage buffer", name_, b.name);
            b.type = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
            return;
        }
        b.type = storage ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        if (dim == spv::Dim2D) b.view = arrayed ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
        if (dim == spv::DimCube) b.view = arrayed ? VK_IMAGE_VIEW_TYPE_CUBE_ARRAY : VK_IMAGE_VIEW_TYPE_CUBE;
        LUXEL_ASSERT(b.view != VK_IMAGE_VIEW_TYPE_MAX_ENUM,
                     "{}: {} has dimension {}, which luxel's images have not", name_, b.name, int(dim));
        if (storage) {
            b.reads = !variable.non_readable;
            b.writes = !variable.non_writable;
            b.format = storage_format(spv::ImageFormat(image.operands[6]));
        }
    }

    VkFormat storage_format(spv::ImageFormat format) const {
        switch (format) {
        case spv::ImageFormatUnknown:
            return VK_FORMAT_UNDEFINED;
        case spv::ImageFormatR8:
            return VK_FORMAT_R8_UNORM;
        case spv::ImageFormatRg8:
            return VK_FORMAT_R8G8_UNORM;
        case spv::ImageFormatRgba8:
            return VK_FORMAT_R8G8B8A8_UNORM;
        case spv::ImageFormatR8ui:
            return VK_FORMAT_R8_UINT;
        case spv::ImageFormatRgba8ui:
            return VK_FORMAT_R8G8B8A8_UINT;
        case spv::ImageFormatR16:
            return VK_FORMAT_R16_UNORM;
        case spv::ImageFormatRgba16:
            return VK_FORMAT_R16G16B16A16_UNORM;
        case spv::ImageFormatR16ui:
            return VK_FORMAT_R16_UINT;
        case spv::ImageFormatRgba16ui:
            return VK_FORMAT_R16G16B16A16_UINT;
        case spv::ImageFormatR16f:
            return VK_FORMAT_R16_SFLOAT;
        case spv::ImageFormatRg16f:
            return VK_FORMAT_R16G16_SFLOAT;
        case spv::ImageFormatRgba16f:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
        case spv::ImageFormatR32ui:
            return VK_FORMAT_R32_UINT;
        case spv::ImageFormatR32i:
            return VK_FORMAT_R32_SINT;
        case spv::ImageFormatRg32ui:
            return VK_FORMAT_R32G32_UINT;
        case spv::ImageFormatRgba32ui:
            return VK_FORMAT_R32G32B32A32_UINT;
        case spv::ImageFormatR32f:
            return VK_FORMAT_R32_SFLOAT;
        case spv::ImageFormatRg32f:
            return VK_FORMAT_R32G32_SFLOAT;
        case spv::ImageFormatRgba32f:
            return VK_FORMAT_R32G32B32A32_SFLOAT;
        case spv::ImageFormatR11fG11fB10f:
            return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
        case spv::ImageFormatRgb10A2:
            return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
        default:
            LUXEL_ASSERT(false, "{}: storage image format {} is not in gpu/format.cpp", name_, int(format));
        }
        return VK_FORMAT_UNDEFINED;
    }

    const std::string& name_;
    std::unordered_map<std::uint32_t, Id> ids_;
    Reflection head_;
    std::vector<std::uint32_t> local_size_ids_;
};

} // namespace

Reflection reflect(std::span<const std::uint32_t> words, const std::string& name) {
    return Module(words, name).reflection();
}

} // namespace luxel::gpu
