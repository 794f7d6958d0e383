#include "firmware_host/tracker/libusb_transport.h"

#include "firmware_host/tracker/usb_ids.h"

#include <fmt/format.h>
#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <array>

namespace frustumscreen::tracker {

namespace {

constexpr int tracker_interface = 0;

struct ContextCloser {
    void operator()(libusb_context* context) const { libusb_exit(context); }
};
struct HandleCloser {
    void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using Context = std::unique_ptr<libusb_context, ContextCloser>;
using Handle = std::unique_ptr<libusb_device_handle, HandleCloser>;

struct Endpoints {
    unsigned char in = 0;
    unsigned char out = 0;
    int out_packet = 0; ///< bytes
    [[nodiscard]] bool complete() const { return in != 0 && out != 0; }
};

/// The first bulk endpoint of each direction.
Endpoints bulk_endpoints(libusb_device* device) {
    Endpoints found;
    libusb_config_descriptor* config = nullptr;
    if (libusb_get_active_config_descriptor(device, &config) != LIBUSB_SUCCESS) {
        return found;
    }
    if (config->bNumInterfaces > tracker_interface &&
        config->interface[tracker_interface].num_altsetting > 0) {
        const libusb_interface_descriptor& wanted = config->interface[tracker_interface].altsetting[0];
        for (int k = 0; k < wanted.bNumEndpoints; ++k) {
            const libusb_endpoint_descriptor& endpoint = wanted.endpoint[k];
            const bool bulk =
                (endpoint.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) == LIBUSB_TRANSFER_TYPE_BULK;
            const bool in = (endpoint.bEndpointAddress & LIBUSB_ENDPOINT_DIR_MASK) == LIBUSB_ENDPOINT_IN;
            if (bulk && in && found.in == 0) {
                found.in = endpoint.bEndpointAddress;
            } else if (bulk && !in && found.out == 0) {
                found.out = endpoint.bEndpointAddress;
                found.out_packet = endpoint.wMaxPacketSize;
            }
        }
    }
    libusb_free_config_descriptor(config);
    return found;
}

unsigned milliseconds(Nanoseconds timeout) {
    // For libusb 0 means no timeout.
    const auto count = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
    return static_cast<unsigned>(std::clamp<std::int64_t>(count, 1, 60'000));
}

class LibusbTransport final : public UsbTransport {
public:
    LibusbTransport(Handle handle, const Endpoints& endpoints)
        : handle_(std::move(handle)), endpoints_(endpoints) {}
    ~LibusbTransport() override { LibusbTransport::close(); }
    LibusbTransport(const LibusbTransport&) = delete;
    LibusbTransport& operator=(const LibusbTransport&) = delete;

    [[nodiscard]] Result<std::size_t> read(std::span<std::byte> buffer, Nanoseconds timeout) override {
        int count = 0;
        const int error =
            handle_ ? libusb_bulk_transfer(handle_.get(), endpoints_.in,
                                           reinterpret_cast<unsigned char*>(buffer.data()),
                                           static_cast<int>(buffer.size()), &count, milliseconds(timeout))
                    : LIBUSB_ERROR_NO_DEVICE;
        if (error == LIBUSB_SUCCESS || error == LIBUSB_ERROR_TIMEOUT || error == LIBUSB_ERROR_INTERRUPTED) {
            // A transfer that timed out may have brought a part.
            return static_cast<std::size_t>(std::max(count, 0));
        }
        if (error == LIBUSB_ERROR_PIPE && libusb_clear_halt(handle_.get(), endpoints_.in) == LIBUSB_SUCCESS) {
            return 0U; // if it stays halted, the session reports silence and the driver searches again
        }
        return lost("reading", error);
    }

    [[nodiscard]] Result<void> write(std::span<const std::byte> bytes, Nanoseconds timeout) override {
        const int size = static_cast<int>(bytes.size());
        int error = send(bytes, timeout);
        if (error == LIBUSB_SUCCESS && endpoints_.out_packet > 0 && size % endpoints_.out_packet == 0) {
            // An empty packet marks the end of a transfer whose last packet is full.
            error = send({}, timeout);
        }
        if (error != LIBUSB_SUCCESS && error != LIBUSB_ERROR_TIMEOUT) {
            return lost("writing", error);
        }
        return {}; // a device that takes nothing in time does not answer either, and the session reports that
    }

    void close() override {
        if (handle_) {
            libusb_release_interface(handle_.get(), tracker_interface);
            handle_.reset();
        }
    }

private:
    int send(std::span<const std::byte> bytes, Nanoseconds timeout) {
        if (!handle_) {
            return LIBUSB_ERROR_NO_DEVICE;
        }
        int count = 0;
        // libusb does not write to what it sends.
        auto* data = reinterpret_cast<unsigned char*>(const_cast<std::byte*>(bytes.data()));
        const int error = libusb_bulk_transfer(handle_.get(), endpoints_.out, data,
                                               static_cast<int>(bytes.size()), &count, milliseconds(timeout));
        return error == LIBUSB_SUCCESS && count != static_cast<int>(bytes.size()) ? LIBUSB_ERROR_IO : error;
    }
    static tl::unexpected<Error> lost(const char* doing, int error) {
        return fail(ErrorKind::DeviceLost, "tracker.usb_failed",
                    "tracker: {} over USB failed: {}; check its cable", doing, libusb_strerror(error));
    }

    Handle handle_;
    Endpoints endpoints_;
};

tl::expected<std::unique_ptr<UsbTransport>, UsbTrackerState> open(libusb_device* device) {
    const auto trouble = [](int error) {
        switch (error) {
        case LIBUSB_ERROR_ACCESS:
            return UsbTrackerState::NoPermission;
        case LIBUSB_ERROR_BUSY:
            return UsbTrackerState::InUse;
        case LIBUSB_ERROR_NO_DEVICE:
            return UsbTrackerState::NotConnected;
        default: // trouble of this one device: its descriptors, hub or cable
            return UsbTrackerState::CannotBeOpened;
        }
    };
    libusb_device_handle* opened = nullptr;
    if (const int error = libusb_open(device, &opened); error != LIBUSB_SUCCESS) {
        return tl::unexpected(trouble(error));
    }
    Handle handle(opened);
    libusb_set_auto_detach_kernel_driver(handle.get(), 1);
    if (const int error = libusb_claim_interface(handle.get(), tracker_interface); error != LIBUSB_SUCCESS) {
        return tl::unexpected(trouble(error));
    }
    const Endpoints endpoints = bulk_endpoints(device);
    if (!endpoints.complete()) {
        return tl::unexpected(UsbTrackerState::CannotBeOpened);
    }
    return std::make_unique<LibusbTransport>(std::move(handle), endpoints);
}

/// Bus number and chain of ports.
std::string place_of(libusb_device* device) {
    std::array<std::uint8_t, 7> ports{}; // the deepest chain of hubs that USB allows
    const int count = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
    return fmt::format("usb {}-{}", libusb_get_bus_number(device),
                       fmt::join(std::span(ports).first(static_cast<std::size_t>(std::max(count, 0))), "."));
}

class LibusbBus final : public UsbBus {
public:
    [[nodiscard]] tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> but_not) override {
        if (!context_) {
            libusb_context* context = nullptr;
            if (libusb_init(&context) != LIBUSB_SUCCESS) {
                return tl::unexpected(UsbTrackerState::UsbFailed);
            }
            context_.reset(context);
        }
        libusb_device** devices = nullptr;
        const ssize_t count = libusb_get_device_list(context_.get(), &devices);
        if (count < 0) {
            return tl::unexpected(UsbTrackerState::UsbFailed);
        }
        auto found = first_of(std::span(devices, static_cast<std::size_t>(count)), but_not);
        libusb_free_device_list(devices, 1);
        return found;
    }

private:
    static tl::expected<FoundTracker, UsbTrackerState> first_of(std::span<libusb_device*> devices,
                                                                std::span<const std::string> but_not) {
        UsbTrackerState trouble = UsbTrackerState::NotConnected;
        for (libusb_device* device : devices) {
            libusb_device_descriptor descriptor{};
            if (libusb_get_device_descriptor(device, &descriptor) != LIBUSB_SUCCESS) {
                continue;
            }
            const std::optional<KnownTracker> known =
                known_tracker(descriptor.idVendor, descriptor.idProduct);
            if (!known) {
                continue;
            }
            std::string place = place_of(device);
            if (std::find(but_not.begin(), but_not.end(), place) != but_not.end()) {
                continue;
            }
            if (!known->firmware_loaded) {
                trouble = UsbTrackerState::FirmwareNotLoaded;
                continue;
            }
            tl::expected<std::unique_ptr<UsbTransport>, UsbTrackerState> transport = open(device);
            if (transport) {
                return FoundTracker{std::move(*transport), known->model, std::move(place)};
            }
            trouble = transport.error();
        }
        return tl::unexpected(trouble);
    }

    Context context_;
};

} // namespace

std::unique_ptr<UsbBus> make_libusb_bus() {
    return std::make_unique<LibusbBus>();
}

} // namespace frustumscreen::tracker
