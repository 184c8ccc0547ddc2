"""Which implementations a test with states by hand runs."""
import subprocess


def on_this_processor(voxmelt):
    """All of them but auto, which is one of the others, and devices."""
    lines = subprocess.run([voxmelt, "list", "implementations"], check=True, capture_output=True, text=True).stdout.splitlines()
    return [name for name in (line.split()[0] for line in lines if "not on this processor" not in line) if name != "auto" and not name.startswith("gpu:")]


def of_hand_tests(voxmelt, words):
    """The reference and the widest vectors, or all with --all. The unit tests compare those between with the reference."""
    names = on_this_processor(voxmelt)
    return names if "--all" in words or len(names) < 2 else [names[0], names[-1]]
