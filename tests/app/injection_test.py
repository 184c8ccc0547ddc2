#!/usr/bin/env python3
"""Every system call that changes files or starts children fails, with each error that it documents.

  injection_test.py PROGRAM [FEWEST]

Each command runs once under `strace`, which lists its calls. Then it runs once for each (call, error, place among the
calls of its name): the first, the middle and the last one on files of ours. Whatever fails: the program ends within
ten seconds, by an exit code and not by a signal, says why in one line, and every frame that was whole is still there.
Without strace it is skipped.
"""
import collections
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from program import PROGRAM, SMALL, write

# As the manual pages of section 2 have them.
DOCUMENTED = {
    "openat": "EACCES EDQUOT EIO EMFILE ENFILE ENOMEM ENOSPC EROFS", "write": "EDQUOT EFBIG EIO ENOSPC", "writev": "EDQUOT EFBIG EIO ENOSPC",
    "pwrite64": "EDQUOT EFBIG EIO ENOSPC", "fsync": "EDQUOT EINVAL EIO ENOSPC EROFS", "fdatasync": "EDQUOT EINVAL EIO ENOSPC",
    "fchmod": "EIO EPERM EROFS", "chmod": "EIO EPERM EROFS", "fchmodat": "EIO EPERM EROFS",
    "rename": "EACCES EBUSY EDQUOT EIO ENOSPC EPERM EROFS EXDEV", "renameat2": "EACCES EBUSY EINVAL EIO ENOSPC ENOSYS EPERM EROFS EXDEV",
    "mkdir": "EACCES EDQUOT EIO EMLINK ENOSPC EROFS", "unlink": "EACCES EBUSY EIO EPERM EROFS", "unlinkat": "EACCES EBUSY EIO EPERM EROFS",
    "rmdir": "EACCES EBUSY EIO EPERM EROFS", "flock": "EINTR EINVAL ENOLCK", "link": "EIO EMLINK ENOSPC EPERM EXDEV", "linkat": "EIO EMLINK ENOSPC EPERM EXDEV",
    "close": "EDQUOT EIO ENOSPC", "ftruncate": "EFBIG EINVAL EIO", "copy_file_range": "EIO ENOSPC EXDEV", "sendfile": "EIO ENOMEM",
    "clone": "EAGAIN ENOMEM", "clone3": "EAGAIN ENOMEM", "vfork": "EAGAIN ENOMEM", "fork": "EAGAIN ENOMEM", "pipe2": "EMFILE ENFILE", "socketpair": "EMFILE ENFILE",
    "execve": "EACCES EIO ENOENT ENOEXEC ENOMEM", "sendto": "ECONNRESET ENOBUFS EPIPE", "poll": "EINTR ENOMEM", "setpgid": "EACCES EPERM",
    "statx": "EACCES EIO ENOSYS", "getdents64": "EIO", "ioctl": "ENOTTY",
}
COMMANDS = {
    "run": "run scene.toml --steps 12 --frame-every 3 --size 64x48 --out out --threads 1",
    "checkpoints": "run scene.toml --steps 12 --frame-every 3 --size 64x48 --out out --threads 1 --checkpoint-every 4",
    "resume": "run --resume stopped --threads 1",
    "export": "export scene.toml --steps 4 --out out --threads 1",
    "render": "render scene.toml --steps 4 --size 64x48 --out picture.png --threads 1",
    "turntable": "render scene.toml --turntable 4 --size 64x48 --out out --threads 1",
    "verify": "verify scene.toml --steps 2 --report report.json --html page.html --threads 1",
}
FINE = {0, 2, 3, 4}


def trace(arguments, folder, log, *options):
    begin = time.monotonic()
    result = subprocess.run(["strace", "-f", "-qq", "-o", log, *options, PROGRAM, *arguments.split()], cwd=folder, env=environment(folder),
                            capture_output=True, text=True, timeout=60, errors="replace")
    return result, time.monotonic() - begin


def environment(folder):
    return {**os.environ, "PATH": f"{folder}/programs:/usr/bin:/bin", "XDG_CACHE_HOME": f"{folder}/cache"}


def fresh(template, folder):
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(template, folder, symlinks=True)


def places(log, folder):
    """Of each call: its ordinals in the first process, from where it first names a folder of ours."""
    seen, ours, found = collections.Counter(), False, collections.defaultdict(list)
    first = None
    for line in log.read_text(errors="replace").splitlines():
        process, _, text = line.partition(" ")
        first = first or process
        name = re.match(r"\s*(\w+)\(", text)
        if process != first or not name:
            continue
        seen[name[1]] += 1
        ours = ours or ("scene.toml" in text and "openat" in text) or "stopped" in text and "openat" in text
        if ours and name[1] in DOCUMENTED:
            found[name[1]].append(seen[name[1]])
    return {call: sorted({all_of[0], all_of[len(all_of) // 2], all_of[-1]}) for call, all_of in found.items()}


def whole_frames(log):
    """Frames that were put into their place."""
    return set(re.findall(r'rename\("[^"]*", "[^"]*/((?:frame|view)_\d+\.png)"\) = 0', log.read_text(errors="replace")))


def judge(name, result, seconds, log, folder, frames):
    if result.returncode not in FINE:
        return f"exit code {result.returncode}"
    if seconds > 10:
        return f"took {seconds:.0f} s"
    said = [line for line in result.stderr.splitlines() if not line.startswith(("warning:", "step "))]
    if result.returncode != 0 and not said:
        return "said nothing"
    there = {p.name: p.read_bytes() for p in folder.rglob("*.png") if ".partial" not in p.name and "old" not in p.parts}
    lost = [frame for frame in sorted(whole_frames(log)) if there.get(frame) != frames.get(frame)]
    if lost:
        return f"lost {', '.join(lost)}"
    if result.returncode == 0 and name in ("run", "checkpoints", "resume") and not set(frames) <= set(there):
        return "complete, it says, and frames are missing"
    return None


def main():
    if not shutil.which("strace") or subprocess.run(["strace", "-qq", "-o", "/dev/null", "true"], capture_output=True).returncode != 0:
        print("strace is missing, or may not trace")
        sys.exit(77)
    fewest = int(sys.argv[2]) if len(sys.argv) > 2 else 400
    problems, triples, codes = [], 0, collections.Counter()
    with tempfile.TemporaryDirectory() as place:
        place = Path(place)
        template, folder, log = place / "template", place / "work", place / "log"
        template.mkdir()
        write(template, SMALL)
        (template / "programs").mkdir()
        film = write(template / "programs", "#!/bin/sh\nfor film; do :; done\ncase \"$*\" in */dev/zero*) exit 0;; esac\ncat > \"$film\"\n", "ffmpeg")
        film.chmod(0o755)
        subprocess.run([PROGRAM, *"run scene.toml --steps 12 --frame-every 3 --size 64x48 --out frames --quiet".split()], cwd=template, check=True,
                       env=environment(template), stdout=subprocess.DEVNULL)
        frames = {p.name: p.read_bytes() for p in (template / "frames/frames").iterdir()}
        shutil.rmtree(template / "frames")
        # A run that has died, with frames and a checkpoint of step 8.
        dead = subprocess.run(["strace", "-f", "-qq", "-o", "/dev/null", "-e", "inject=renameat2,rename:signal=KILL:when=9", PROGRAM,
                               *"run scene.toml --steps 12 --frame-every 3 --size 64x48 --out stopped --checkpoint-every 2 --threads 1 --quiet".split()],
                              cwd=template, env=environment(template), capture_output=True)
        assert dead.returncode != 0 and list(template.glob("stopped.partial-*/checkpoints/*")), "the run that is to die has not"
        for name, arguments in COMMANDS.items():
            fresh(template, folder)
            result, _ = trace(arguments, folder, log)
            assert result.returncode == 0, (name, result.stderr)
            views = {p.name: p.read_bytes() for p in folder.rglob("view_*.png")}
            for call, ordinals in sorted(places(log, folder).items()):
                for error in DOCUMENTED[call].split():
                    for ordinal in ordinals:
                        fresh(template, folder)
                        what = f"{name}: {call} {error}, number {ordinal}"
                        try:
                            result, seconds = trace(arguments, folder, log, "-e", f"inject={call}:error={error}:when={ordinal}")
                        except subprocess.TimeoutExpired:
                            problems.append(f"{what}: it hangs")
                            continue
                        triples += 1
                        codes[result.returncode] += 1
                        if wrong := judge(name, result, seconds, log, folder, views if name == "turntable" else frames):
                            problems.append(f"{what}: {wrong}\n    {result.stderr.strip()[-200:]}")
    if triples < fewest:
        problems.append(f"only {triples} triples")
    print("\n".join(problems))
    print(f"{triples} triples of call, error and command; exit codes {dict(sorted(codes.items()))}; {len(problems)} problems")
    sys.exit(bool(problems))


main()
