// The display's libdrm functions, on the fake kernel. They are hidden: Mesa continues to use the real ones.
#include "tests/display/fake_kernel.h"

#include <algorithm>
#include <cerrno>
#include <iterator>

using namespace frustumscreen;
using namespace frustumscreen::display;

struct _drmModeAtomicReq {
    std::vector<FakeChange> changes;
};

namespace {

/// A structure with the lists that its pointers reference.
template <typename T> struct WithLists {
    T value{};
    std::vector<std::uint32_t> first, second, third;
    std::vector<std::uint64_t> wide;
    std::vector<drmModeModeInfo> modes;
    std::vector<drm_mode_property_enum> choices;
};

template <typename T> T* hand_out(const std::shared_ptr<WithLists<T>>& made, const char* kind) {
    FakeKernel::instance().hand_out(&made->value, kind, made);
    return &made->value;
}

void take_back(const void* what, std::string_view kind) {
    if (what != nullptr) {
        FakeKernel::instance().give_back(what, kind);
    }
}

int count(const std::vector<std::uint32_t>& list) {
    return static_cast<int>(list.size());
}

int failed(int error) {
    errno = error;
    return -error;
}

/// The kernel's checks before it calls a card's driver.
struct Call {
    Call(const char* name, int number, bool of_the_master = false)
        : file(FakeKernel::instance().file(number)) {
        FakeKernel& kernel = FakeKernel::instance();
        error = kernel.enter(name);
        if (error == 0 && (file == nullptr || file->card == nullptr)) {
            error = EBADF;
        } else if (error == 0 && file->card->gone) {
            error = ENODEV;
        } else if (error == 0 && of_the_master && !file->card->is_master(*file)) {
            error = EACCES;
        }
        errno = error != 0 ? error : errno;
    }
    [[nodiscard]] FakeCard& card() const { return *file->card; }
    /// Like DRM_IOCTL in xf86drmMode.c: returns the negative error number.
    [[nodiscard]] static int answer(int refused) { return refused != 0 ? failed(-refused) : 0; }

    FakeFile* file;
    int error = 0;
};

drmModeConnectorPtr connector_of(const Call& call, std::uint32_t id, bool probes) {
    const auto& all = call.card().connectors();
    if (call.error == 0 &&
        (!call.file->holds(id) ||
         std::none_of(all.begin(), all.end(), [id](const FakeConnector& one) { return one.id == id; }))) {
        errno = ENOENT;
        return nullptr;
    }
    FakeConnector& connector = call.card().connector(id);
    if (probes && call.card().is_master(*call.file)) { // drm_mode_getconnector: others get the last known
                                                       // state
        call.card().probe(connector);
    }
    const auto made = std::make_shared<WithLists<drmModeConnector>>();
    for (const drmModeModeInfo& mode : connector.modes) {
        if (call.file->stereo || (mode.flags & DRM_MODE_FLAG_3D_MASK) == 0) {
            made->modes.push_back(mode);
        }
    }
    made->first = connector.encoders;
    made->value.connector_id = id;
    made->value.encoder_id = call.card().encoder_of(connector);
    made->value.connector_type = connector.type;
    made->value.connector_type_id = connector.number;
    made->value.connection = connector.known;
    made->value.count_modes = static_cast<int>(made->modes.size());
    made->value.modes = made->modes.data();
    made->value.count_encoders = count(made->first);
    made->value.encoders = made->first.data();
    return hand_out(made, "connector");
}

} // namespace

#pragma GCC visibility push(hidden)
extern "C" {

int drmSetClientCap(int number, std::uint64_t capability, std::uint64_t value) {
    const Call call("drmSetClientCap", number);
    if (call.error != 0) {
        return -1;
    }
    if (capability == DRM_CLIENT_CAP_UNIVERSAL_PLANES && call.card().universal_planes && value <= 1) {
        call.file->universal_planes = value == 1;
        return 0;
    }
    if (capability == DRM_CLIENT_CAP_ATOMIC && call.card().atomic && value <= 2) {
        call.file->atomic = call.file->universal_planes = value != 0;
        return 0;
    }
    if (capability == DRM_CLIENT_CAP_STEREO_3D && value <= 1) { // of the kernel, not of the driver
        call.file->stereo = value == 1;
        return 0;
    }
    errno = capability == DRM_CLIENT_CAP_ATOMIC ? EOPNOTSUPP : EINVAL;
    return -1;
}

int drmGetCap(int number, std::uint64_t capability, std::uint64_t* value) {
    const Call call("drmGetCap", number);
    if (call.error != 0 || capability != DRM_CAP_TIMESTAMP_MONOTONIC) {
        errno = call.error != 0 ? call.error : EINVAL;
        return -1;
    }
    *value = call.card().monotonic ? 1 : 0;
    return 0;
}

/// Like drmIsMaster: a file is master unless the answer is EACCES.
int drmIsMaster(int number) {
    const Call call("drmIsMaster", number, true);
    return call.error != EACCES ? 1 : 0;
}

int drmSetMaster(int number) {
    const Call call("drmSetMaster", number);
    const int refused = call.error == 0 ? call.card().become_master(*call.file) : -call.error;
    errno = refused != 0 ? -refused : errno;
    return refused != 0 ? -1 : 0;
}

drmModeResPtr drmModeGetResources(int number) {
    const Call call("drmModeGetResources", number);
    if (call.error != 0) {
        return nullptr;
    }
    const auto made = std::make_shared<WithLists<drmModeRes>>();
    std::copy_if(call.card().crtcs().begin(), call.card().crtcs().end(), std::back_inserter(made->first),
                 [&call](std::uint32_t crtc) { return call.file->holds(crtc); });
    for (const FakeConnector& connector : call.card().connectors()) {
        if (connector.type != DRM_MODE_CONNECTOR_WRITEBACK &&
            call.file->holds(connector.id)) { // needs a separate client capability
            made->second.push_back(connector.id);
        }
    }
    for (const auto& [encoder, crtcs] : call.card().encoders()) {
        made->third.push_back(encoder);
    }
    made->value.count_crtcs = count(made->first);
    made->value.crtcs = made->first.data();
    made->value.count_connectors = count(made->second);
    made->value.connectors = made->second.data();
    made->value.count_encoders = count(made->third);
    made->value.encoders = made->third.data();
    made->value.max_width = made->value.max_height = 8192;
    return hand_out(made, "resources");
}
void drmModeFreeResources(drmModeResPtr resources) {
    take_back(resources, "resources");
}

drmModeConnectorPtr drmModeGetConnector(int number, std::uint32_t id) {
    const Call call("drmModeGetConnector", number);
    return call.error == 0 ? connector_of(call, id, true) : nullptr;
}
drmModeConnectorPtr drmModeGetConnectorCurrent(int number, std::uint32_t id) {
    const Call call("drmModeGetConnectorCurrent", number);
    return call.error == 0 ? connector_of(call, id, false) : nullptr;
}
void drmModeFreeConnector(drmModeConnectorPtr connector) {
    take_back(connector, "connector");
}

drmModeEncoderPtr drmModeGetEncoder(int number, std::uint32_t id) {
    const Call call("drmModeGetEncoder", number);
    if (call.error != 0 || !call.card().encoders().contains(id)) {
        errno = call.error != 0 ? call.error : ENOENT;
        return nullptr;
    }
    const auto made = std::make_shared<WithLists<drmModeEncoder>>();
    made->value.encoder_id = id;
    made->value.possible_crtcs = call.card().counted(*call.file, call.card().encoders().at(id));
    const std::uint32_t crtc = call.card().crtc_of(id);
    made->value.crtc_id = call.file->holds(crtc) ? crtc : 0;
    return hand_out(made, "encoder");
}
void drmModeFreeEncoder(drmModeEncoderPtr encoder) {
    take_back(encoder, "encoder");
}

drmModePlaneResPtr drmModeGetPlaneResources(int number) {
    const Call call("drmModeGetPlaneResources", number);
    if (call.error != 0) {
        return nullptr;
    }
    const auto made = std::make_shared<WithLists<drmModePlaneRes>>();
    for (const FakePlane& plane : call.card().planes()) {
        if ((call.file->universal_planes || plane.type == DRM_PLANE_TYPE_OVERLAY) &&
            call.file->holds(plane.id)) {
            made->first.push_back(plane.id);
        }
    }
    made->value.count_planes = static_cast<std::uint32_t>(made->first.size());
    made->value.planes = made->first.data();
    return hand_out(made, "list of planes");
}
void drmModeFreePlaneResources(drmModePlaneResPtr planes) {
    take_back(planes, "list of planes");
}

drmModePlanePtr drmModeGetPlane(int number, std::uint32_t id) {
    const Call call("drmModeGetPlane", number);
    if (call.error != 0) {
        return nullptr;
    }
    for (const FakePlane& plane : call.card().planes()) {
        if (plane.id == id && call.file->holds(id)) {
            const auto made = std::make_shared<WithLists<drmModePlane>>();
            made->first = plane.formats;
            made->value.count_formats = static_cast<std::uint32_t>(made->first.size());
            made->value.formats = made->first.data();
            made->value.plane_id = id;
            made->value.crtc_id = static_cast<std::uint32_t>(call.card().value(id, "CRTC_ID"));
            made->value.fb_id = static_cast<std::uint32_t>(call.card().value(id, "FB_ID"));
            made->value.possible_crtcs = call.card().counted(*call.file, plane.possible_crtcs);
            return hand_out(made, "plane");
        }
    }
    errno = ENOENT;
    return nullptr;
}
void drmModeFreePlane(drmModePlanePtr plane) {
    take_back(plane, "plane");
}

drmModeObjectPropertiesPtr drmModeObjectGetProperties(int number, std::uint32_t object,
                                                      std::uint32_t /*kind*/) {
    const Call call("drmModeObjectGetProperties", number);
    const auto* values =
        call.error == 0 && call.file->holds(object) ? call.card().values_of(object) : nullptr;
    if (values == nullptr) {
        errno = call.error != 0 ? call.error : ENOENT;
        return nullptr;
    }
    const auto made = std::make_shared<WithLists<drmModeObjectProperties>>();
    for (const auto& [id, value] : *values) {
        const bool of_atomic = (call.card().property(id)->flags & DRM_MODE_PROP_ATOMIC) != 0;
        if (call.file->atomic || !of_atomic) { // drm_mode_object_get_properties
            made->first.push_back(id);
            made->wide.push_back(value);
        }
    }
    made->value.count_props = static_cast<std::uint32_t>(made->first.size());
    made->value.props = made->first.data();
    made->value.prop_values = made->wide.data();
    return hand_out(made, "list of properties");
}
void drmModeFreeObjectProperties(drmModeObjectPropertiesPtr properties) {
    take_back(properties, "list of properties");
}

drmModePropertyPtr drmModeGetProperty(int number, std::uint32_t id) {
    const Call call("drmModeGetProperty", number);
    const FakeProperty* property = call.error == 0 ? call.card().property(id) : nullptr;
    if (property == nullptr) {
        errno = call.error != 0 ? call.error : ENOENT;
        return nullptr;
    }
    const auto made = std::make_shared<WithLists<drmModePropertyRes>>();
    made->value.prop_id = id;
    made->value.flags = property->flags;
    property->name.copy(made->value.name, DRM_PROP_NAME_LEN - 1);
    made->wide = property->limits;
    for (const auto& [name, value] : property->choices) {
        drm_mode_property_enum choice{};
        choice.value = value;
        name.copy(choice.name, DRM_PROP_NAME_LEN - 1);
        made->choices.push_back(choice);
    }
    made->value.count_values = static_cast<int>(made->wide.size());
    made->value.values = made->wide.data();
    made->value.count_enums = static_cast<int>(made->choices.size());
    made->value.enums = made->choices.data();
    return hand_out(made, "property");
}
void drmModeFreeProperty(drmModePropertyPtr property) {
    take_back(property, "property");
}

int drmModeObjectSetProperty(int number, std::uint32_t object, std::uint32_t /*kind*/, std::uint32_t property,
                             std::uint64_t value) {
    const Call call("drmModeObjectSetProperty", number, true);
    return call.error != 0 ? -call.error : Call::answer(call.card().set_property(object, property, value));
}

int drmModeCreatePropertyBlob(int number, const void* data, std::size_t size, std::uint32_t* id) {
    const Call call("drmModeCreatePropertyBlob", number);
    return call.error != 0 ? -call.error
                           : Call::answer(call.card().create_blob(
                                 *call.file, {static_cast<const std::byte*>(data), size}, id));
}
int drmModeDestroyPropertyBlob(int number, std::uint32_t id) {
    const Call call("drmModeDestroyPropertyBlob", number);
    const int refused = call.file->card->destroy_blob(*call.file, id); // destroyed even if set to fail
    return call.error != 0 ? -call.error : Call::answer(refused);
}

drmModeAtomicReqPtr drmModeAtomicAlloc() {
    FakeKernel& kernel = FakeKernel::instance();
    errno = kernel.enter("drmModeAtomicAlloc");
    if (errno != 0) {
        return nullptr;
    }
    const auto made = std::make_shared<_drmModeAtomicReq>();
    kernel.hand_out(made.get(), "request", made);
    return made.get();
}
void drmModeAtomicFree(drmModeAtomicReqPtr request) {
    take_back(request, "request");
}
/// Returns the number of properties so far.
int drmModeAtomicAddProperty(drmModeAtomicReqPtr request, std::uint32_t object, std::uint32_t property,
                             std::uint64_t value) {
    const int error = FakeKernel::instance().enter("drmModeAtomicAddProperty");
    if (error != 0 || request == nullptr) {
        return error != 0 ? -error : -EINVAL;
    }
    if (object == 0 || property == 0) {
        return -EINVAL;
    }
    request->changes.push_back({object, property, value});
    return static_cast<int>(request->changes.size());
}
/// An empty request is not sent.
int drmModeAtomicCommit(int number, drmModeAtomicReqPtr request, std::uint32_t flags, void* given_back) {
    const Call call("drmModeAtomicCommit", number, true);
    if (request == nullptr) {
        return -EINVAL;
    }
    if (request->changes.empty()) {
        return 0;
    }
    return call.error != 0 ? -call.error
                           : Call::answer(call.card().commit(*call.file, request->changes, flags,
                                                             reinterpret_cast<std::uintptr_t>(given_back)));
}

int drmModeSetCrtc(int number, std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t /*x*/,
                   std::uint32_t /*y*/, std::uint32_t* connectors, int how_many, drmModeModeInfoPtr mode) {
    const Call call("drmModeSetCrtc", number, true);
    if (call.error == 0 && !call.file->holds(crtc)) {
        return failed(ENOENT);
    }
    return call.error != 0
               ? -call.error
               : Call::answer(call.card().set_crtc(
                     crtc, framebuffer, std::span(connectors, static_cast<std::size_t>(how_many)), mode));
}
int drmModePageFlip(int number, std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t flags,
                    void* given_back) {
    const Call call("drmModePageFlip", number, true);
    if (call.error == 0 && !call.file->holds(crtc)) {
        return failed(ENOENT);
    }
    return call.error != 0
               ? -call.error
               : Call::answer(call.card().page_flip(*call.file, crtc, framebuffer, flags,
                                                    reinterpret_cast<std::uintptr_t>(given_back)));
}

int drmModeAddFB2(int number, std::uint32_t width, std::uint32_t height, std::uint32_t /*format*/,
                  const std::uint32_t handles[4], const std::uint32_t pitches[4],
                  const std::uint32_t /*offsets*/[4], std::uint32_t* id, std::uint32_t /*flags*/) {
    const Call call("drmModeAddFB2", number);
    if (call.error == 0 && !call.card().knows_fourcc) {
        return failed(EINVAL);
    }
    return call.error != 0 ? -call.error
                           : Call::answer(call.card().add_framebuffer(*call.file, width, height, handles[0],
                                                                      pitches[0], id));
}
int drmModeAddFB(int number, std::uint32_t width, std::uint32_t height, std::uint8_t depth, std::uint8_t bits,
                 std::uint32_t pitch, std::uint32_t handle, std::uint32_t* id) {
    const Call call("drmModeAddFB", number);
    if (call.error == 0 && (depth != 24 || bits != 32)) { // drm_mode_legacy_fb_format: this means XRGB8888
        return failed(EINVAL);
    }
    return call.error != 0
               ? -call.error
               : Call::answer(call.card().add_framebuffer(*call.file, width, height, handle, pitch, id));
}
int drmModeRmFB(int number, std::uint32_t id) {
    const Call call("drmModeRmFB", number);
    const int refused = call.file->card->remove_framebuffer(*call.file, id); // as with blobs
    return call.error != 0 ? -call.error : Call::answer(refused);
}

int drmModeCreateDumbBuffer(int number, std::uint32_t width, std::uint32_t height, std::uint32_t bits,
                            std::uint32_t /*flags*/, std::uint32_t* handle, std::uint32_t* pitch,
                            std::uint64_t* size) {
    const Call call("drmModeCreateDumbBuffer", number);
    if (call.error != 0 || width == 0 || height == 0 || bits != 32) {
        return failed(call.error != 0 ? call.error : EINVAL);
    }
    *handle = call.card().create_buffer(*call.file, width, height);
    const FakeBuffer* const buffer = call.card().buffer(*call.file, *handle);
    *pitch = buffer->pitch;
    *size = buffer->memory->size();
    return 0;
}
int drmModeMapDumbBuffer(int number, std::uint32_t handle, std::uint64_t* offset) {
    const Call call("drmModeMapDumbBuffer", number);
    if (call.error != 0 || call.card().buffer(*call.file, handle) == nullptr) {
        return failed(call.error != 0 ? call.error : ENOENT);
    }
    *offset = std::uint64_t{handle} << 12U; // in whole pages
    return 0;
}
int drmModeDestroyDumbBuffer(int number, std::uint32_t handle) {
    const Call call("drmModeDestroyDumbBuffer", number);
    const int refused = call.file->card->destroy_buffer(*call.file, handle);
    return call.error != 0 ? -call.error : Call::answer(refused);
}

int drmModeCreateLease(int number, const std::uint32_t* objects, int count, int /*flags*/,
                       std::uint32_t* lessee) {
    const Call call("drmModeCreateLease", number, true);
    const int made =
        call.error != 0
            ? -call.error
            : FakeKernel::instance().lease(*call.file, std::span(objects, static_cast<std::size_t>(count)));
    *lessee = made > 0 ? 1 : 0;
    return made < 0 ? failed(-made) : made;
}

int drmCrtcGetSequence(int number, std::uint32_t crtc, std::uint64_t* sequence, std::uint64_t* ns) {
    const Call call("drmCrtcGetSequence", number);
    const int refused = call.error == 0 ? call.card().sequence(crtc) : -call.error;
    if (refused != 0) {
        errno = -refused;
        return -1;
    }
    *sequence = call.card().refreshes;
    *ns = call.card().time_us * 1000;
    return 0;
}

} // extern "C"
#pragma GCC visibility pop
