# shellcheck shell=sh
# Sourced by the initrd's init, in a test's image alone, when the root is mounted: lays the agent's files over it, in memory, and
# busybox's commands below it, so that those of the root stay what they are.
insmod /extra/virtio_console.ko
mkdir /run/extra
mount -t tmpfs -o mode=755 extra /run/extra
mkdir -p /run/extra/upper /run/extra/work /run/extra/below/usr/bin
cp -a /extra/over/. /run/extra/upper/
busybox --install -s /run/extra/below/usr/bin
# "frustumscreen.test_without=UNIT" on the command line: the start without this unit, to be compared with.
# shellcheck disable=SC2154 # command_line: of initrd/init
for word in $command_line; do
    case $word in
        frustumscreen.test_without=*)
            mkdir -p /run/extra/upper/etc/systemd/system
            ln -s /dev/null "/run/extra/upper/etc/systemd/system/${word#*=}"
            ;;
    esac
done
mount -t overlay -o lowerdir=/root:/run/extra/below,upperdir=/run/extra/upper,workdir=/run/extra/work extra /root
