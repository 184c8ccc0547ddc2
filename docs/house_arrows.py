"""Which folder includes which, at every level of the tree: circles, and how large a room is inside."""
from collections import defaultdict

# What a room with rooms of its own may have at most: rooms, floors and arrows between them.
MOST = {"hwmodel": (8, 5, 15)}


def at_every_level(includes):
    """For each folder the arrows between its children, from pairs of a file's folder and an included one's.

    A child is a folder below it, or "." for its own files.
    """
    levels = defaultdict(set)
    for one, other in includes:
        a, b = one.split("/"), other.split("/")
        same = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
        ends = [path[same] if same < len(path) else "." for path in (a, b)]
        if ends[0] != ends[1]:
            levels["/".join(a[:same])].add(tuple(ends))
    return levels


def floors(rooms, arrows):
    """How many rooms lie on top of each other; None where arrows run in a circle."""
    below = {room: {other for one, other in arrows if one == room} for room in rooms}
    height = {}
    while len(height) < len(rooms):
        ready = [room for room in rooms if room not in height and below[room] <= set(height)]
        if not ready:
            return None
        height.update({room: 1 + max((height[other] for other in below[room]), default=0) for room in ready})
    return max(height.values(), default=0)


def inside(folder, folders, includes):
    """How many rooms, floors and arrows between them a folder has."""
    rooms = {other.split("/")[folder.count("/") + 1] for other in folders if other.startswith(f"{folder}/")}
    arrows = {arrow for arrow in at_every_level(includes).get(folder, set()) if "." not in arrow}
    return len(rooms), floors(rooms, arrows), len(arrows)


def problems(folders, includes):
    """`folders` of all code. Circles at any level, and rooms that have become too large inside."""
    found = []
    for folder, arrows in sorted(at_every_level(includes).items()):
        if floors({end for arrow in arrows for end in arrow}, arrows) is None:
            text = ", ".join(f"{one} -> {other}" for one, other in sorted(arrows))
            found.append(f"{folder or 'the house'}: folders include each other in a circle ({text})")
    for folder, most in MOST.items():
        for name, is_, limit in zip(("rooms", "floors", "arrows"), inside(folder, folders, includes), most):
            if is_ is not None and is_ > limit:
                found.append(f"{folder}: {is_} {name} inside; at most {limit}")
    return found


def self_test():
    # Two rooms below one; an arrow from a folder to one inside it is no circle, one back makes it one.
    fine = {("a/x", "a/y/z"), ("a/y", "b"), ("a", "a/x"), ("a/x", "b")}
    assert at_every_level(fine) == {"a": {("x", "y"), (".", "x")}, "": {("a", "b")}}, at_every_level(fine)
    assert problems({"a/x", "a/y/z", "b"}, fine) == []
    for more, place in ((("b/c", "a/y"), "the house"), (("a/y/z", "a/x"), "a"), (("a/x", "a"), "a")):
        assert [p.split(":")[0] for p in problems(set(), fine | {more})] == [place], more
    assert floors({"1", "2", "3", "4"}, {("1", "2"), ("2", "3"), ("1", "3")}) == 3
    rooms = [f"hwmodel/{i}" for i in range(9)]
    chain = {(rooms[i], rooms[i + 1]) for i in range(8)}
    assert problems(set(rooms), chain) == ["hwmodel: 9 rooms inside; at most 8", "hwmodel: 9 floors inside; at most 5"]
    flat = {(rooms[i], rooms[j]) for i in range(4) for j in range(4, 8)}
    assert problems(set(rooms[:8]), flat) == ["hwmodel: 16 arrows inside; at most 15"]
