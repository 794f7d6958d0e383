# Turns the shipped settings, which need no device, into those of a new kiosk.
s|^packs = .*|packs = ["/usr/share/frustumscreen/built_in.fspack"]|
s|^words = .*|words = "/usr/share/frustumscreen/words.fswords" # the exhibit's own words|
s|^kind = "simulated" # or "usb"|kind = "usb" # or "simulated", without a tracker; "usb"|
s|^kind = "scripted" # or "gpio": real buttons, with|kind = "gpio" # real buttons: a USB bridge CP2112; or "scripted": no buttons|
s|^# chip = "gpiochip0" |chip = "cp2112_gpio"|
s|^# lines = \["4", "5", "6"\] |lines = ["2", "3", "4"]|
/^script = \[/,/^\]/d
/^repeat_s = /d
