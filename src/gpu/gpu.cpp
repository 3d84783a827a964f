// SPDX-License-Identifier: MIT
// Making, filling and reading of images and buffers.
#include "gpu/gpu.h"

#include <algorithm>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "gpu/check.h"
#include "gpu/commands.h"
#include "gpu/recorder_data.h"

namespace luxel::gpu {
namespace {

std::uint64_t texel_bytes(VkFormat format) { return std::uint64_t(format_info(format).texel_bytes); }

// One texel as numbers; normalized formats in [0, 1], sRGB ones as they are encoded.
void decode(const FormatInfo& info, const std::byte* texel, float* out) {
    const VkFormat format = info.format;
    const int bytes = info.texel_bytes / info.channels;
    if (format == VK_FORMAT_B10G11R11_UFLOAT_PACK32 || format == VK_FORMAT_A2B10G10R10_UNORM_PACK32) {
        std::uint32_t packed;
        std::memcpy(&packed, texel, 4);
        const bool is_float = format == VK_FORMAT_B10G11R11_UFLOAT_PACK32;
        const glm::vec4 v =
            is_float ? glm::vec4(glm::unpackF2x11_1x10(packed), 1.0f) : glm::unpackUnorm3x10_1x2(packed);
        std::memcpy(out, &v, sizeof v);
        return;
    }
    for (int c = 0; c < info.channels; ++c) {
        std::uint32_t bits = 0; // little endian, as every Vulkan host is here
        std::memcpy(&bits, texel + c * bytes, std::size_t(bytes));
        if (info.numbers == Numbers::uint_)
            out[c] = float(bits);
        else if (info.numbers == Numbers::int_)
            out[c] = float(std::int32_t(bits));
        else if (bytes == 4)
            std::memcpy(&out[c], &bits, 4);
        else if (bytes == 1)
            out[c] = float(bits) / 255.0f;
        else if (format == VK_FORMAT_R16_UNORM || format == VK_FORMAT_R16G16B16A16_UNORM)
            out[c] = float(bits) / 65535.0f;
        else
            out[c] = glm::unpackHalf1x16(std::uint16_t(bits));
    }
}

VkSampler make_sampler(const Context& context, Sampler kind) {
    const bool nearest = kind == Sampler::nearest_clamp || kind == Sampler::nearest_repeat;
    const bool repeat = kind == Sampler::nearest_repeat || kind == Sampler::linear_repeat;
    const bool mirror = kind == Sampler::linear_mirror;
    const bool compare = kind == Sampler::shadow_compare;
    const VkSamplerAddressMode address = repeat   ? VK_SAMPLER_ADDRESS_MODE_REPEAT
                                         : mirror ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT
                                                  : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const VkFilter filter = nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
    const VkSamplerCreateInfo create{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                     .magFilter = filter,
                                     .minFilter = filter,
                                     .mipmapMode = nearest ? VK_SAMPLER_MIPMAP_MODE_NEAREST
                                                           : VK_SAMPLER_MIPMAP_MODE_LINEAR,
                                     .addressModeU = address,
                                     .addressModeV = address,
                                     .addressModeW = address,
                                     .compareEnable = compare,
                                     .compareOp = compare ? VK_COMPARE_OP_LESS_OR_EQUAL : VK_COMPARE_OP_NEVER,
                                     .maxLod = VK_LOD_CLAMP_NONE};
    VkSampler sampler = VK_NULL_HANDLE;
    LUXEL_VK(vkCreateSampler(context.device, &create, nullptr, &sampler), "sampler");
    return sampler;
}

} // namespace

GpuData::GpuData(const GpuOptions& options) : context(std::make_shared<Context>(options)) {
    for (std::size_t i = 0; i < samplers.size(); ++i) samplers[i] = make_sampler(*context, Sampler(i));
}

GpuData::~GpuData() {
    for (VkSampler sampler : samplers) vkDestroySampler(context->device, sampler, nullptr);
}

Program& GpuData::program(std::string_view name) {
    const auto found = programs.find(name);
    if (found != programs.end()) return *found->second;
    return *programs.emplace(std::string(name), std::make_unique<Program>(context, name)).first->second;
}

Gpu::Gpu(const GpuOptions& options) : data_(std::make_unique<GpuData>(options)) {}
Gpu::~Gpu() = default;

const DeviceInfo& Gpu::device() const { return data_->context->info; }
MemoryUse Gpu::memory() const { return data_->context->memory; }
void Gpu::reset_memory_peak() { data_->context->memory.peak = data_->context->memory.now; }

std::vector<std::string> Gpu::validation_messages() const {
    const std::lock_guard lock(data_->context->log->mutex);
    return data_->context->log->messages;
}

Image Gpu::image(const ImageInfo& info, std::string name) {
    Image image;
    image.data_ = std::make_shared<ImageData>(data_->context, info, std::move(name));
    return image;
}

Buffer Gpu::buffer(std::uint64_t size, std::string name, Memory memory) {
    Buffer buffer;
    buffer.data_ = std::make_shared<BufferData>(data_->context, size, memory, std::move(name));
    return buffer;
}

void Gpu::write(const Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t offset) {
    LUXEL_ASSERT(offset + bytes.size() <= buffer.size(), "{} bytes at {} of buffer {} with {}", bytes.size(),
                 offset, buffer.name(), buffer.size());
    BufferStorage& storage = buffer.data_->storage;
    LUXEL_ASSERT(storage.kind == Memory::upload, "buffer {} is not Memory::upload", buffer.name());
    if (!bytes.empty())
        std::memcpy(static_cast<std::byte*>(storage.mapped) + offset, bytes.data(), bytes.size());
    storage.verified.written = true;
}

Buffer Gpu::upload_bytes(std::span<const std::byte> bytes, std::string name) {
    const Buffer staging =
        buffer(std::max<std::size_t>(bytes.size(), 16), name + " (staging)", Memory::upload);
    const std::byte nothing[16] = {};
    write(staging, bytes.empty() ? std::span<const std::byte>(nothing) : bytes);
    const Buffer made = buffer(bytes.size(), std::move(name));
    Commands commands(*data_);
    copy_buffer(commands, staging, 0, made, std::max<std::size_t>(bytes.size(), 16 * bytes.empty()));
    commands.submit();
    return made;
}

Image Gpu::upload_image(const ImageInfo& info, std::span<const std::byte> texels, std::string name) {
    LUXEL_ASSERT(texels.size() ==
                     std::uint64_t(info.width) * info.height * info.layers * texel_bytes(info.format),
                 "{} bytes for image {} of {}x{}, {} layers, {}", texels.size(), name, info.width,
                 info.height, info.layers, format_info(info.format).name);
    const Buffer staging = buffer(texels.size(), name + " (staging)", Memory::upload);
    write(staging, texels);
    const Image made = image(info, std::move(name));
    Commands commands(*data_);
    copy_buffer_to_image(commands, staging, made.mip(0));
    blit_mips(commands, made);
    commands.submit();
    return made;
}

Image Gpu::upload_mips(const ImageInfo& info, std::span<const std::byte> texels, std::string name) {
    const Image made = image(info, std::move(name));
    Commands commands(*data_);
    for (std::uint32_t level = 0; level < info.mips; ++level) {
        const Image mip = made.mip(level);
        const std::size_t size =
            std::size_t(mip.width()) * mip.height() * info.layers * texel_bytes(info.format);
        LUXEL_ASSERT(size <= texels.size(), "{} bytes for mip {} of image {}", texels.size(), level,
                     made.name());
        const Buffer staging =
            buffer(size, fmt::format("{} (staging of mip {})", made.name(), level), Memory::upload);
        write(staging, texels.first(size));
        texels = texels.subspan(size);
        copy_buffer_to_image(commands, staging, mip);
    }
    LUXEL_ASSERT(texels.empty(), "{} bytes left over for image {}", texels.size(), made.name());
    commands.submit();
    return made;
}

bool Gpu::can_filter(VkFormat format) const {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(data_->context->physical, format, &properties);
    constexpr VkFormatFeatureFlags needed =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    return (properties.optimalTilingFeatures & needed) == needed;
}

Image Gpu::upload_image(const luxel::Image& source, std::string name) {
    LUXEL_ASSERT(source.channels == 1 || source.channels == 3 || source.channels == 4,
                 "image {} has {} channels", name, source.channels);
    ImageInfo info{.width = std::uint32_t(source.width), .height = std::uint32_t(source.height)};
    if (source.channels == 1) info.format = VK_FORMAT_R32_SFLOAT;
    if (source.channels != 3)
        return upload_image(info, std::as_bytes(std::span(source.data)), std::move(name));

    // There is no storage for 3 channels: alpha is 1.
    std::vector<float> rgba(source.pixels() * 4, 1.0f);
    for (std::size_t i = 0; i < source.pixels(); ++i) std::copy_n(&source.data[3 * i], 3, &rgba[4 * i]);
    return upload_image(info, std::as_bytes(std::span(rgba)), std::move(name));
}

luxel::Image Gpu::read(const Image& image) {
    const Range range = range_of(image);
    LUXEL_ASSERT(range.mips == 1 && range.layers == 1,
                 "image {} has {} mips and {} layers; select one to read", image.name(), range.mips,
                 range.layers);
    const VkFormat format = image.info().format;
    const std::uint64_t bytes = std::uint64_t(image.width()) * image.height() * texel_bytes(format);
    const Buffer staging = buffer(bytes, image.name() + " (readback)", Memory::readback);
    Commands commands(*data_);
    copy_image_to_buffer(commands, image, staging);
    commands.submit();

    // 32-bit floats are what the image holds; other formats are decoded.
    const FormatInfo& info = format_info(format);
    luxel::Image out(int(image.width()), int(image.height()), info.channels);
    const auto* texel = static_cast<const std::byte*>(staging.data_->storage.mapped);
    if (info.numbers == Numbers::float_ && info.texel_bytes == 4 * info.channels) {
        std::memcpy(out.data.data(), texel, std::size_t(bytes));
        return out;
    }
    for (std::size_t i = 0; i < out.pixels(); ++i, texel += info.texel_bytes)
        decode(info, texel, &out.data[i * std::size_t(out.channels)]);
    return out;
}

void Gpu::read(const Buffer& source, std::span<std::byte> out, std::uint64_t offset) {
    LUXEL_ASSERT(offset + out.size() <= source.size(), "{} bytes at {} of buffer {} with {}", out.size(),
                 offset, source.name(), source.size());
    if (out.empty()) return;
    if (source.data_->storage.kind == Memory::readback) {
        std::memcpy(out.data(), static_cast<const std::byte*>(source.data_->storage.mapped) + offset,
                    out.size());
        return;
    }
    const Buffer staging = buffer(out.size(), source.name() + " (readback)", Memory::readback);
    Commands commands(*data_);
    copy_buffer(commands, source, offset, staging, out.size());
    commands.submit();
    std::memcpy(out.data(), staging.data_->storage.mapped, out.size());
}

} // namespace luxel::gpu
