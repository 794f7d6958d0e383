// Devices listed in umockdev's format, whose ioctls a test answers; plugged in during the lifetime of
// PluggedDevices. The program is started by umockdev-wrapper.
#pragma once

#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <umockdev.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <list>
#include <string>
#include <vector>

namespace frustumscreen::panel {

/// A device's answer to one ioctl: its result, or minus an errno, and the bytes.
struct Answer {
    int result = 0;
    std::vector<std::byte> bytes;
};

/// An ioctl as received by the kernel.
class Asked {
public:
    Asked(unsigned long request, UMockdevIoctlData* argument) : request_(request), argument_(argument) {
        std::memcpy(&value_, argument->data, sizeof value_);
    }
    [[nodiscard]] unsigned long request() const { return request_; }
    [[nodiscard]] bool has_argument() const { return value_ != nullptr; }
    /// The struct referenced by the argument.
    template <typename Struct> [[nodiscard]] Struct argument() const {
        Struct value{};
        UMockdevIoctlData* const bytes =
            umockdev_ioctl_data_resolve(argument_, 0, _IOC_SIZE(request_), nullptr);
        std::memcpy(&value, bytes->data, std::min<std::size_t>(sizeof value, _IOC_SIZE(request_)));
        g_object_unref(bytes);
        return value;
    }

private:
    unsigned long request_;
    UMockdevIoctlData* argument_;
    void* value_ = nullptr;
};

class PluggedDevices {
public:
    using Answers = std::function<Answer(const Asked&)>;

    explicit PluggedDevices(const std::string& listed) : testbed_(umockdev_testbed_new()) {
        EXPECT_TRUE(umockdev_testbed_add_from_string(testbed_, listed.c_str(), nullptr));
    }
    PluggedDevices(const std::string& listed, const std::string& node, Answers answers)
        : PluggedDevices(listed) {
        answer(node, std::move(answers));
    }
    ~PluggedDevices() {
        for (const Node& node : nodes_) {
            umockdev_testbed_detach_ioctl(testbed_, node.path.c_str(), nullptr);
            g_object_unref(node.handler);
        }
        g_object_unref(testbed_);
    }
    PluggedDevices(const PluggedDevices&) = delete;
    PluggedDevices& operator=(const PluggedDevices&) = delete;

    /// `answers` is called on umockdev's thread.
    void answer(const std::string& node, Answers answers) {
        nodes_.push_back({node, std::move(answers), umockdev_ioctl_base_new()});
        g_signal_connect(nodes_.back().handler, "handle-ioctl", G_CALLBACK(&PluggedDevices::handle),
                         &nodes_.back());
        EXPECT_TRUE(umockdev_testbed_attach_ioctl(testbed_, node.c_str(), nodes_.back().handler, nullptr));
    }

private:
    struct Node {
        std::string path;
        Answers answers;
        UMockdevIoctlBase* handler;
    };
    static gboolean handle(UMockdevIoctlBase*, UMockdevIoctlClient* client, Node* node) {
        UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
        const Answer answer = node->answers(Asked(umockdev_ioctl_client_get_request(client), argument));
        if (!answer.bytes.empty()) {
            UMockdevIoctlData* bytes = umockdev_ioctl_data_resolve(argument, 0, answer.bytes.size(), nullptr);
            std::memcpy(bytes->data, answer.bytes.data(), answer.bytes.size());
            g_object_unref(bytes);
        }
        umockdev_ioctl_client_complete(client, answer.result < 0 ? -1 : answer.result,
                                       answer.result < 0 ? -answer.result : 0);
        return TRUE;
    }

    UMockdevTestbed* testbed_;
    std::list<Node> nodes_; ///< a list, because addresses of its elements are in use
};

} // namespace frustumscreen::panel
