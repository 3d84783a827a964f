// SPDX-License-Identifier: MIT
// Instance, choice of the device, its features, validation.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "gpu/check.h"
#include "gpu/context.h"
#include "gpu/format.h"

namespace luxel::gpu {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";
// Of drivers on top of another interface (MoltenVK), which must be enabled where it is there; its name stands
// in a header of provisional extensions.
constexpr const char* portability_subset = "VK_KHR_portability_subset";

// Everything that is asked of a device, in the one chain that both queries and enables.
struct Features {
    VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceShaderAtomicFloatFeaturesEXT atomic_float{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_FLOAT_FEATURES_EXT};

    explicit Features(bool with_atomic_float) {
        core.pNext = &v12;
        v12.pNext = &v13;
        if (with_atomic_float) v13.pNext = &atomic_float;
    }
    Features(const Features&) = delete;
    Features& operator=(const Features&) = delete;

    struct Item {
        const char* name;
        VkBool32* flag;
    };
    std::vector<Item> required() {
        return {{"dynamicRendering", &v13.dynamicRendering},
                {"synchronization2", &v13.synchronization2},
                {"maintenance4", &v13.maintenance4},
                {"shaderDemoteToHelperInvocation", &v13.shaderDemoteToHelperInvocation},
                {"scalarBlockLayout", &v12.scalarBlockLayout},
                {"shaderOutputLayer", &v12.shaderOutputLayer},
                {"imageCubeArray", &core.features.imageCubeArray},
                {"independentBlend", &core.features.independentBlend},
                {"depthClamp", &core.features.depthClamp},
                {"fragmentStoresAndAtomics", &core.features.fragmentStoresAndAtomics},
                {"shaderStorageImageWriteWithoutFormat", &core.features.shaderStorageImageWriteWithoutFormat},
                {"shaderStorageImageExtendedFormats", &core.features.shaderStorageImageExtendedFormats}};
    }
    std::vector<VkBool32*> optional() {
        return {&v13.shaderTerminateInvocation,
                &v12.shaderOutputViewportIndex,
                &core.features.vertexPipelineStoresAndAtomics,
                &core.features.shaderImageGatherExtended,
                &core.features.largePoints,
                &core.features.shaderInt64,
                &atomic_float.shaderBufferFloat32Atomics,
                &atomic_float.shaderBufferFloat32AtomicAdd,
                &atomic_float.shaderImageFloat32Atomics,
                &atomic_float.shaderImageFloat32AtomicAdd,
                &atomic_float.shaderSharedFloat32Atomics,
                &atomic_float.shaderSharedFloat32AtomicAdd};
    }
};

bool has_extension(VkPhysicalDevice device, const char* name) {
    std::uint32_t count = 0;
    LUXEL_VK(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), "device extensions");
    std::vector<VkExtensionProperties> all(count);
    LUXEL_VK(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, all.data()), "device extensions");
    return std::any_of(all.begin(), all.end(),
                       [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
}

bool has_instance_extension(const char* layer, const char* name) {
    std::uint32_t count = 0;
    LUXEL_VK(vkEnumerateInstanceExtensionProperties(layer, &count, nullptr), "instance extensions");
    std::vector<VkExtensionProperties> all(count);
    LUXEL_VK(vkEnumerateInstanceExtensionProperties(layer, &count, all.data()), "instance extensions");
    return std::any_of(all.begin(), all.end(),
                       [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
}

// Without this flag the loader hides drivers that are not fully conformant; why_unsuitable() says what they
// lack.
VkInstanceCreateFlags enumerate_portable(std::vector<const char*>& extensions) {
    if (!has_instance_extension(nullptr, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) return 0;
    extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    return VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
}

// The first family that can do everything; techniques use one queue.
std::optional<std::uint32_t> queue_family_of(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & needed) == needed && families[i].timestampValidBits > 0) return i;
    }
    return std::nullopt;
}

const char* type_name(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual";
    default:
        return "cpu";
    }
}

std::string why_unsuitable(VkPhysicalDevice device, std::uint32_t api_version) {
    if (api_version < VK_API_VERSION_1_3) return "it has no Vulkan 1.3";
    if (!queue_family_of(device)) return "it has no queue with graphics, compute and timestamps";
    Features features(false);
    vkGetPhysicalDeviceFeatures2(device, &features.core);
    for (const auto& item : features.required()) {
        if (!*item.flag) return fmt::format("it lacks {}", item.name);
    }
    const std::string missing = missing_format_use([device](VkFormat format) {
        VkFormatProperties properties{};
        vkGetPhysicalDeviceFormatProperties(device, format, &properties);
        return properties.optimalTilingFeatures;
    });
    if (!missing.empty()) return "it lacks " + missing;
    return "";
}

DeviceInfo describe(VkPhysicalDevice device, int index) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    all.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &all);
    const VkPhysicalDeviceProperties& p = all.properties;

    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    std::uint64_t bytes = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            bytes += memory.memoryHeaps[i].size;
    }
    return {.index = index,
            .name = p.deviceName,
            .driver = fmt::format("{} {}", driver.driverName, driver.driverInfo),
            .type = type_name(p.deviceType),
            .api_version =
                fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(p.apiVersion),
                            VK_API_VERSION_MINOR(p.apiVersion), VK_API_VERSION_PATCH(p.apiVersion)),
            .memory_bytes = bytes,
            .unsuitable = why_unsuitable(device, p.apiVersion)};
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
    std::uint32_t count = 0;
    if (vkEnumeratePhysicalDevices(instance, &count, nullptr) != VK_SUCCESS) return {};
    std::vector<VkPhysicalDevice> all(count);
    LUXEL_VK(vkEnumeratePhysicalDevices(instance, &count, all.data()), "devices");
    return all;
}

VkApplicationInfo application_info() {
    return {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
            .pApplicationName = "luxel",
            .apiVersion = VK_API_VERSION_1_3};
}

// By index, by part of the name, or the best kind; the first of equals.
int choose(const std::vector<DeviceInfo>& devices, const std::string& wanted) {
    constexpr const char* advice = "install a driver with Vulkan 1.3 (Mesa's lavapipe runs on any CPU)";
    if (devices.empty()) fail(Fault::unsupported, "gpu: no Vulkan device was found; {}", advice);
    const auto usable = [&](const DeviceInfo& d) {
        if (!d.unsuitable.empty())
            fail(Fault::unsupported, "gpu: {} cannot be used: {}", d.name, d.unsuitable);
        return d.index;
    };

    // What was asked for, exactly.
    int number = -1;
    const char* end = wanted.data() + wanted.size();
    const auto parsed = std::from_chars(wanted.data(), end, number);
    const bool is_number = !wanted.empty() && parsed.ec == std::errc() && parsed.ptr == end;
    for (const DeviceInfo& d : devices) {
        if (is_number ? d.index == number : !wanted.empty() && d.name.find(wanted) != std::string::npos)
            return usable(d);
    }
    std::string known;
    for (const DeviceInfo& d : devices)
        known += fmt::format("{}{}: {}{}", known.empty() ? "" : ", ", d.index, d.name,
                             d.unsuitable.empty() ? "" : " (" + d.unsuitable + ")");
    if (!wanted.empty()) fail(Fault::usage, "gpu: no device is called \"{}\"; there are {}", wanted, known);

    for (const char* type : {"discrete", "integrated", "virtual", "cpu"}) {
        for (const DeviceInfo& d : devices) {
            if (d.type == type && d.unsuitable.empty()) return d.index;
        }
    }
    fail(Fault::unsupported, "gpu: no device can be used ({}); {}", known, advice);
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& log = *static_cast<MessageLog*>(user);
    const std::lock_guard lock(log.mutex);
    log.messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

void destroy_messenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance, messenger, nullptr);
}

// Hazards across submits are an experimental check that this generation of the layer takes from the
// environment alone. The variable is read inside vkCreateInstance.
void ask_for_submit_checks() {
    constexpr const char* variable = "VK_LAYER_ENABLES";
    constexpr const char* check_name = "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT";
    const char* before = std::getenv(variable);
    const std::string value = before ? before : "";
    if (value.find(check_name) != std::string::npos) return;
    ::setenv(variable, (value.empty() ? check_name : value + ":" + check_name).c_str(), 1);
}

} // namespace

bool validation_available() {
    std::uint32_t count = 0;
    LUXEL_VK(vkEnumerateInstanceLayerProperties(&count, nullptr), "layers");
    std::vector<VkLayerProperties> all(count);
    LUXEL_VK(vkEnumerateInstanceLayerProperties(&count, all.data()), "layers");
    return std::any_of(all.begin(), all.end(),
                       [](const auto& l) { return std::strcmp(l.layerName, validation_layer) == 0; });
}

std::vector<DeviceInfo> list_devices() {
    const VkApplicationInfo application = application_info();
    std::vector<const char*> extensions;
    const VkInstanceCreateFlags portability = enumerate_portable(extensions);
    const VkInstanceCreateInfo create{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                      .flags = portability,
                                      .pApplicationInfo = &application,
                                      .enabledExtensionCount = std::uint32_t(extensions.size()),
                                      .ppEnabledExtensionNames = extensions.data()};
    VkInstance instance = VK_NULL_HANDLE;
    if (vkCreateInstance(&create, nullptr, &instance) != VK_SUCCESS) return {};
    std::vector<DeviceInfo> devices;
    for (VkPhysicalDevice d : physical_devices(instance)) devices.push_back(describe(d, int(devices.size())));
    vkDestroyInstance(instance, nullptr);
    return devices;
}

Context::Context(const GpuOptions& options) {
    try {
        make_instance(options);
        const std::vector<VkPhysicalDevice> devices = physical_devices(instance);
        std::vector<DeviceInfo> infos;
        for (VkPhysicalDevice d : devices) infos.push_back(describe(d, int(infos.size())));
        const auto chosen = std::size_t(choose(infos, options.device));
        physical = devices[chosen];
        info = infos[chosen];
        make_device();
    } catch (...) {
        // The destructor does not run for what was only half made.
        if (messenger_) destroy_messenger(instance, messenger_);
        if (instance) vkDestroyInstance(instance, nullptr);
        throw;
    }
}

void Context::make_instance(const GpuOptions& options) {
    if (options.validation && !validation_available())
        fail(Fault::unsupported, "gpu: validation was asked for but {} is not installed", validation_layer);
    const bool debug_utils =
        has_instance_extension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
        (options.validation && has_instance_extension(validation_layer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));

    VkDebugUtilsMessengerCreateInfoEXT messages{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = on_message,
        .pUserData = log.get()};
    const VkValidationFeatureEnableEXT enables[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
        VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT,
        VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT};
    const VkValidationFeaturesEXT validation{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                             .enabledValidationFeatureCount = options.check_shaders ? 3u : 1u,
                                             .pEnabledValidationFeatures = enables};
    messages.pNext = &validation;
    if (options.validation) ask_for_submit_checks();

    std::vector<const char*> extensions;
    if (debug_utils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (options.validation) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    const VkInstanceCreateFlags portability = enumerate_portable(extensions);
    const VkApplicationInfo application = application_info();
    const VkInstanceCreateInfo create{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                      .pNext = options.validation ? &messages : nullptr,
                                      .flags = portability,
                                      .pApplicationInfo = &application,
                                      .enabledLayerCount = options.validation ? 1u : 0u,
                                      .ppEnabledLayerNames = &validation_layer,
                                      .enabledExtensionCount = std::uint32_t(extensions.size()),
                                      .ppEnabledExtensionNames = extensions.data()};
    const VkResult result = vkCreateInstance(&create, nullptr, &instance);
    if (result != VK_SUCCESS)
        fail(Fault::unsupported,
             "gpu: no Vulkan driver was found ({}); install one, for example Mesa's lavapipe", int(result));

    if (debug_utils) {
        set_object_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
            vkGetInstanceProcAddr(instance, "vkSetDebugUtilsObjectNameEXT"));
        begin_label = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
            vkGetInstanceProcAddr(instance, "vkCmdBeginDebugUtilsLabelEXT"));
        end_label = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(
            vkGetInstanceProcAddr(instance, "vkCmdEndDebugUtilsLabelEXT"));
    }
    if (options.validation) {
        const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
        messages.pNext = nullptr;
        LUXEL_VK(create_messenger(instance, &messages, nullptr, &messenger_), "messages");
    }
}

void Context::make_device() {
    VkPhysicalDeviceMaintenance4Properties buffers{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
    VkPhysicalDeviceMaintenance3Properties allocations{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    allocations.pNext = &buffers;
    all.pNext = &allocations;
    vkGetPhysicalDeviceProperties2(physical, &all);
    properties = all.properties;
    largest_allocation = std::min(buffers.maxBufferSize, allocations.maxMemoryAllocationSize);
    vkGetPhysicalDeviceMemoryProperties(physical, &memory_types);
    queue_family = queue_family_of(physical).value();

    // Ask for what is there of the chain, then clear what luxel does not use.
    const bool atomic_float = has_extension(physical, VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME);
    Features present(atomic_float), wanted(atomic_float);
    vkGetPhysicalDeviceFeatures2(physical, &present.core);
    for (const auto& item : wanted.required()) *item.flag = VK_TRUE;
    const auto from = present.optional(), to = wanted.optional();
    for (std::size_t i = 0; i < to.size(); ++i) *to[i] = *from[i];

    std::vector<const char*> extensions;
    if (atomic_float) extensions.push_back(VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME);
    if (has_extension(physical, portability_subset)) extensions.push_back(portability_subset);
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queues{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                         .queueFamilyIndex = queue_family,
                                         .queueCount = 1,
                                         .pQueuePriorities = &priority};
    const VkDeviceCreateInfo create{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                    .pNext = &wanted.core,
                                    .queueCreateInfoCount = 1,
                                    .pQueueCreateInfos = &queues,
                                    .enabledExtensionCount = std::uint32_t(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
    LUXEL_VK(vkCreateDevice(physical, &create, nullptr, &device), info.name);
    vkGetDeviceQueue(device, queue_family, 0, &queue);
    blocks_.emplace(device);
}

Context::~Context() {
    trim(0);
    blocks_.reset();
    vkDestroyDevice(device, nullptr);
    if (messenger_) destroy_messenger(instance, messenger_);
    vkDestroyInstance(instance, nullptr);
}

void Context::set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!set_object_name_) return;
    const VkDebugUtilsObjectNameInfoEXT object{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                               .objectType = type,
                                               .objectHandle = handle,
                                               .pObjectName = name.c_str()};
    LUXEL_VK(set_object_name_(device, &object), name);
}

} // namespace luxel::gpu
