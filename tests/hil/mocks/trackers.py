"""The trackers that can be played, by the name on the command line."""

from .hid_tracker import HidTracker
from .patriot import LibertyHs, Patriot, PatriotHs, PatriotUnloaded
from .viper import Viper

DEVICES = {device.name: device for device in (Viper, Patriot, PatriotHs, PatriotUnloaded, LibertyHs, HidTracker)}
