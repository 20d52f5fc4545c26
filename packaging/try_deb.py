"""Tries the Debian package on a fresh Debian, as a user who is not root, and removes it again.

``python3 packaging/try_deb.py [FILE.deb] [--from OLDER.deb] [--release trixie] [--root FOLDER]``, as root, with
debootstrap and the network; without FILE the package in ``dist``. With --from, the older package is installed first, a
visitor plays, and FILE takes its place. Where nothing can be tried it says why and ends with 0. FOLDER keeps the fresh
Debian for next time.
Mounts are made in a namespace of their own, so that nothing is mounted any more when a command ends.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RELEASE = "bookworm"
"""Debian 12, which the package is made for."""
USER = "visitor"
DATA = f"/home/{USER}/data"
COPIED = ("etc/apt/apt.conf.d", "etc/apt/auth.conf.d", "etc/ssl/certs", "etc/resolv.conf", "etc/hosts")
"""Of this machine: how its packages are fetched."""

INSIDE = 'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && exec chroot "$0" "$@"'

PIN = f"scrypt:16:{'0' * 32}:{'0' * 64}"
"""A PIN of the right form, which no digits open."""

KEEP = f"""
printf '[experimenter]\npin_hash = "{PIN}"\n' > study.toml
recollect run --supervise --json --data {DATA} --study study.toml > kept &
supervisor=$!
for _ in $(seq 300); do grep -q '"ready"' kept && break; sleep 0.1; done
kill -9 $(pgrep -f '^[^ ]*recollect run --unattended')
for _ in $(seq 300); do grep -c '"ready"' kept | grep -q 2 && break; sleep 0.1; done
kill -TERM $supervisor
wait $supervisor
echo "the supervisor ended with $?"
cat kept
grep -c '"ready"' kept | grep -q 2
"""


def main() -> int:
    """Try the package, or say why not; returns the exit code."""
    parser = argparse.ArgumentParser()
    parser.add_argument("package", type=Path, nargs="?")
    parser.add_argument("--from", dest="older", type=Path, help="is installed first, and upgraded")
    parser.add_argument("--release", default=RELEASE, help="of Debian, by name")
    parser.add_argument("--root", type=Path, help="keeps the fresh Debian here")
    arguments = parser.parse_args()
    why = _why_not()
    if why:
        print(f"The package is not tried: {why}.")
        return 0
    package = arguments.package or next((ROOT / "dist").glob("recollect_*.deb"), None)
    if package is None:
        print("There is no package in dist yet: run python3 packaging/build.py all first.", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory(prefix="recollect-deb-") as folder:
        fresh = arguments.root or Path(folder) / "fresh"
        _make_fresh(fresh, arguments.release)
        tried = Path(folder) / "tried"
        subprocess.run(["/bin/cp", "--archive", fresh, tried], check=True)
        return _try(package, arguments.older, tried)


def _why_not() -> str:
    if sys.platform != "linux" or os.geteuid() != 0:
        return "only root can make a fresh Debian"
    missing = [program for program in ("debootstrap", "unshare", "chroot") if shutil.which(program) is None]
    return f"{missing[0]} is missing" if missing else ""


def _make_fresh(fresh: Path, release: str) -> None:
    """Make a fresh Debian, with the network and the certificates of this machine, if it is not there."""
    if (fresh / "etc" / "debian_version").exists():
        return
    print(f"Making a fresh Debian ({release}).", flush=True)
    subprocess.run(
        [shutil.which("debootstrap") or "debootstrap", "--variant=minbase", release, str(fresh)],
        stdout=subprocess.DEVNULL,
        check=True,
    )


def _try(package: Path, older: Path | None, root: Path) -> int:
    """Install, use and remove it; 0 if all is as it should be."""
    for name in COPIED:
        source = Path("/") / name
        if source.is_dir():
            shutil.copytree(source, root / name, symlinks=True, dirs_exist_ok=True)
        elif source.exists():
            shutil.copyfile(source, root / name)
    given = [each for each in (older, package) if each is not None]
    for each in given:
        shutil.copyfile(each, root / "tmp" / each.name)
    apt = ("env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-qq", "-y", "--no-install-recommends")
    user = ("runuser", "--login", USER, "--command")
    steps: list[tuple[str, tuple[str, ...]]] = [
        ("apt knows its packages", (*apt, "update")),
        ("there is a user", ("useradd", "--create-home", "--shell", "/bin/sh", USER)),
        *(
            step
            for seed, each in enumerate(given, 1)
            for step in (
                (f"{each.name} installs", (*apt, "install", f"/tmp/{each.name}")),  # noqa: S108 - in the fresh Debian
                ("it tells its version", (*user, "recollect --version")),
                ("a visitor plays", (*user, f"recollect rehearse --headless --seed {seed} --data {DATA} --json")),
            )
        ),
        ("every session is there, as it was written", (*user, f"recollect verify --data {DATA}")),
        ("there is a screen to try", (*apt, "install", "xvfb", "xauth", "procps")),
        ("it is kept up", (*user, f"cat > keep.sh <<'END'{KEEP}END\nxvfb-run -a sh keep.sh")),
        ("it is removed", (*apt, "remove", "recollect")),
        ("the program is gone", ("test", "!", "-e", "/usr/lib/recollect")),
        ("nothing of it is left to purge", ("sh", "-c", "! dpkg --status recollect")),
        ("the data are still there", ("test", "-s", f"{DATA}/recollect.db")),
    ]
    for what, command in steps:
        if not _inside(root, what, command):
            return 1
    print("The package can be installed, used and removed.")
    return 0


def _inside(root: Path, what: str, command: tuple[str, ...]) -> bool:
    """Run a command in the fresh Debian and tell whether it went well."""
    namespace = ["unshare", "--mount", "--pid", "--fork", "--propagation", "private"]
    done = subprocess.run(
        [*namespace, "sh", "-c", INSIDE, str(root), *command],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    print(f"{'yes' if done.returncode == 0 else 'NO '}  {what}", flush=True)
    if done.returncode or "runuser" in command:
        print((done.stdout + done.stderr).strip()[-3000:], flush=True)
    return done.returncode == 0


if __name__ == "__main__":
    sys.exit(main())
