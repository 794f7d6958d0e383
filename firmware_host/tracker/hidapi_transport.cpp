#include "firmware_host/tracker/hidapi_transport.h"

#include "firmware_host/tracker/hid_ids.h"

#include <fmt/format.h>
#include <hidapi/hidapi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <vector>

namespace frustumscreen::tracker {

namespace {

constexpr std::size_t longest_report = 64; ///< of a full-speed device

struct DeviceCloser {
    void operator()(hid_device* device) const { hid_close(device); }
};
struct ListCloser {
    void operator()(hid_device_info* first) const { hid_free_enumeration(first); }
};
using Device = std::unique_ptr<hid_device, DeviceCloser>;
using DeviceList = std::unique_ptr<hid_device_info, ListCloser>;

class HidapiTransport final : public UsbTransport {
public:
    /// The first read returns `first_report`, unless it is empty.
    HidapiTransport(Device device, std::vector<std::byte> first_report)
        : device_(std::move(device)), first_report_(std::move(first_report)) {}

    [[nodiscard]] Result<std::size_t> read(std::span<std::byte> buffer, Nanoseconds timeout) override {
        if (!first_report_.empty()) {
            const std::size_t count = std::min(first_report_.size(), buffer.size());
            std::copy_n(first_report_.begin(), count, buffer.begin());
            first_report_.clear();
            return count;
        }
        const auto ms = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
        const int count =
            device_ ? hid_read_timeout(device_.get(), reinterpret_cast<unsigned char*>(buffer.data()),
                                       buffer.size(), static_cast<int>(std::max<std::int64_t>(ms, 0)))
                    : -1;
        if (count < 0) {
            return fail(ErrorKind::DeviceLost, "tracker.hid_gone", "the HID device is gone");
        }
        return static_cast<std::size_t>(count);
    }
    /// `bytes` are an output report, with its id first.
    [[nodiscard]] Result<void> write(std::span<const std::byte> bytes, Nanoseconds /*timeout*/) override {
        const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
        if (!device_ || hid_write(device_.get(), data, bytes.size()) < 0) {
            return fail(ErrorKind::DeviceLost, "tracker.hid_gone_writing", "the HID device is gone");
        }
        return {};
    }
    void close() override { device_.reset(); }

private:
    Device device_;
    std::vector<std::byte> first_report_;
};

tl::expected<FoundTracker, UsbTrackerState> open(const char* path, UsbTrackerModel model) {
    Device device(hid_open_path(path));
    if (!device) {
        const bool exists = ::access(path, F_OK) == 0;
        const bool allowed = ::access(path, R_OK | W_OK) == 0;
        return tl::unexpected(exists && !allowed ? UsbTrackerState::NoPermission
                                                 : UsbTrackerState::NotConnected);
    }
    std::vector<std::byte> first_report;
    if (model == UsbTrackerModel::Hid) {
        std::array<unsigned char, longest_report> report{};
        report[0] = hid_tracker_info_report;
        const int count = hid_get_feature_report(device.get(), report.data(), report.size());
        if (count <= 0) {
            return tl::unexpected(UsbTrackerState::SetUpRefused);
        }
        const auto bytes = std::as_bytes(std::span(report)).first(static_cast<std::size_t>(count));
        first_report.assign(bytes.begin(), bytes.end());
    }
    return FoundTracker{std::make_unique<HidapiTransport>(std::move(device), std::move(first_report)), model,
                        path};
}

class HidapiBus final : public UsbBus {
public:
    explicit HidapiBus(UsbTrackerModel model) : model_(model) {}
    ~HidapiBus() override { hid_exit(); }
    HidapiBus(const HidapiBus&) = delete;
    HidapiBus& operator=(const HidapiBus&) = delete;

    [[nodiscard]] tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> but_not) override {
        UsbTrackerState trouble = UsbTrackerState::NotConnected;
        const DeviceList devices(hid_enumerate(0, 0)); // initialises hidapi the first time
        for (const hid_device_info* at = devices.get(); at != nullptr; at = at->next) {
            if (known_hid_tracker({.vendor = at->vendor_id,
                                   .product = at->product_id,
                                   .usage_page = at->usage_page,
                                   .usage = at->usage}) != model_ ||
                std::find(but_not.begin(), but_not.end(), at->path) != but_not.end()) {
                continue;
            }
            auto found = open(at->path, model_);
            if (found) {
                return found;
            }
            trouble = found.error();
        }
        return tl::unexpected(trouble);
    }
    [[nodiscard]] bool reports_table_frame() const override { return model_ == UsbTrackerModel::SpaceMouse; }

private:
    UsbTrackerModel model_;
};

} // namespace

std::unique_ptr<UsbBus> make_hid_bus(UsbTrackerModel model) {
    return std::make_unique<HidapiBus>(model);
}

} // namespace frustumscreen::tracker
