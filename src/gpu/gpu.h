// SPDX-License-Identifier: MIT
// Device, images, buffers: a thin layer over Vulkan 1.3. Handles are shared; a resource lives until its last
// handle and the last submit that uses it are gone.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "core/image.h"

namespace luxel::gpu {

struct DeviceInfo {
    int index;
    std::string name, driver, type; // type: discrete, integrated, virtual, cpu
    std::string api_version;
    std::uint64_t memory_bytes;
    std::string unsuitable; // why luxel cannot use it; empty = it can
};
std::vector<DeviceInfo> list_devices();

struct GpuOptions {
    std::string device;      // index or part of a name; "" = discrete before integrated before cpu
    bool validation = false; // Khronos layer with synchronization validation; messages are counted and kept
    bool check_shaders =
        false; // with validation: instrument shaders, which finds accesses out of bounds (slow)
};

struct GpuData; // internal
struct ImageData;
struct BufferData;

struct ImageInfo {
    std::uint32_t width = 1, height = 1;
    VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    std::uint32_t mips = 1, layers = 1;
    bool cube = false; // layers is a multiple of 6
};

// A GPU image. View-selecting copies share the same storage: image.mip(2), image.layer(3).
class Image {
public:
    Image() = default;
    explicit operator bool() const { return data_ != nullptr; }
    const ImageInfo& info() const;
    const std::string& name() const;
    std::uint32_t width() const; // of the selected mip
    std::uint32_t height() const;
    Image mip(std::uint32_t level) const;   // one level
    Image layer(std::uint32_t index) const; // one layer, as a 2D image
    std::uint64_t bytes() const;            // device memory of the whole image

    std::shared_ptr<ImageData> data_;
    std::uint32_t first_mip = 0, mip_count = 0, first_layer = 0, layer_count = 0; // 0 counts = all
    bool single_layer = false;                                                    // seen as a 2D image
};

enum class Memory { device, upload, readback };

class Buffer {
public:
    Buffer() = default;
    explicit operator bool() const { return data_ != nullptr; }
    std::uint64_t size() const; // bytes
    const std::string& name() const;

    std::shared_ptr<BufferData> data_;
};

struct MemoryUse {
    std::uint64_t now = 0, peak = 0; // bytes of images and buffers alive
};

class Gpu {
public:
    explicit Gpu(const GpuOptions& options = {});
    ~Gpu();
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    // Contents are undefined until written. Usable as sampled, storage (if the format can), attachment, copy
    // source and target. Errors: Fault::resource with what was asked.
    Image image(const ImageInfo& info, std::string name);
    Buffer buffer(std::uint64_t size, std::string name, Memory memory = Memory::device);
    template <class T> Buffer upload(std::span<const T> values, std::string name) {
        return upload_bytes(std::as_bytes(values), std::move(name));
    }
    Buffer upload_bytes(std::span<const std::byte> bytes,
                        std::string name); // device-local copy; empty is allowed
    // Mip 0 of an image from tightly packed rows; further mips are made by linear blits when info.mips > 1.
    Image upload_image(const ImageInfo& info, std::span<const std::byte> texels, std::string name);
    // The same with every mip's texels given, the levels behind one another.
    Image upload_mips(const ImageInfo& info, std::span<const std::byte> texels, std::string name);
    // Whether images of this format can be sampled and filtered linearly.
    bool can_filter(VkFormat format) const;
    Image upload_image(const luxel::Image& image, std::string name); // 1 -> R32F, 3 and 4 channels -> RGBA32F

    // Into Memory::upload; what is submitted afterwards sees it.
    void write(const Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t offset = 0);

    // Waits for all work, then reads. Float images become 1-, 2- or 4-channel luxel::Image; 8-bit ones [0,
    // 1], sRGB as encoded; integers their value.
    luxel::Image read(const Image& image);
    void read(const Buffer& buffer, std::span<std::byte> out, std::uint64_t offset = 0);
    template <class T> std::vector<T> read_all(const Buffer& b) {
        std::vector<T> out(b.size() / sizeof(T));
        read(b, std::as_writable_bytes(std::span<T>(out)));
        return out;
    }

    const DeviceInfo& device() const;
    MemoryUse memory() const;
    void reset_memory_peak();
    // Validation messages so far (empty without GpuOptions::validation).
    std::vector<std::string> validation_messages() const;
    GpuData& data() { return *data_; }

private:
    std::unique_ptr<GpuData> data_;
};

} // namespace luxel::gpu
