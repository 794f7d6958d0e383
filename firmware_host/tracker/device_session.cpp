#include "firmware_host/tracker/device_session.h"

#include "firmware_host/tracker/hid_tracker_session.h"
#include "firmware_host/tracker/patriot_session.h"
#include "firmware_host/tracker/space_mouse_session.h"
#include "firmware_host/tracker/viper_session.h"

namespace frustumscreen::tracker {

std::unique_ptr<DeviceSession> make_session(UsbTrackerModel model, const UsbTrackerSetUp& set_up) {
    switch (model) {
    case UsbTrackerModel::Viper:
        return std::make_unique<ViperSession>(set_up);
    case UsbTrackerModel::Patriot:
    case UsbTrackerModel::Liberty:
        return std::make_unique<PatriotSession>(set_up);
    case UsbTrackerModel::Hid:
        return std::make_unique<HidTrackerSession>();
    case UsbTrackerModel::SpaceMouse:
        return std::make_unique<SpaceMouseSession>(set_up.table_half_m);
    }
    return nullptr;
}

} // namespace frustumscreen::tracker
