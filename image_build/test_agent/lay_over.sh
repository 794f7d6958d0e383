# shellcheck shell=sh
# The initrd's init sources this script when the root is mounted; only a test's image has it. It lays the agent's files over the root, in
# memory, and busybox's commands below the root, so that the root's own commands take precedence.
insmod /extra/virtio_console.ko
mkdir /run/extra
mount -t tmpfs -o mode=755 extra /run/extra
mkdir -p /run/extra/upper /run/extra/work /run/extra/below/usr/bin
cp -a /extra/over/. /run/extra/upper/
busybox --install -s /run/extra/below/usr/bin
# "frustumscreen.test_without=UNIT" on the command line masks this unit, to compare starts with and without it.
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
