"""The trackers that can be played, by the name on the command line."""

from .viper import Viper

DEVICES = {"viper": Viper}
