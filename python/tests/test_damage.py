# SPDX-License-Identifier: BSD-3-Clause
"""Damaged bags: what is whole is read, and one sentence says what is not."""

import random
import re
import shutil
import struct
import subprocess

import pytest

from lego_loam_sc.compression import zstd
from made_bags import (
    KINDS,
    Messages,
    copy_bag,
    stamp_of,
    storage_file,
    sweep,
    write_bag,
    write_sweeps,
)

COUNT = 8
UNCOMPRESSED = ["ros1", "mcap"]
COMPRESSED = ["ros1_lz4", "ros1_bz2", "mcap_chunks", "mcap_messages", "mcap_file", "sqlite_file"]

SQLITE = shutil.which("sqlite3")
needs_recovery = pytest.mark.skipif(
    not SQLITE or subprocess.run([SQLITE, ":memory:", ".recover"], capture_output=True).returncode,
    reason="the command sqlite3 is not installed or has no .recover",
)


def stamps(numbers):
    return [stamp_of(number) for number in numbers]


def ends_of_messages(data):
    """The byte behind each message in an uncompressed file: is_dense follows the points."""
    contents = [sweep(number).tobytes() for number in range(COUNT)]
    return [data.index(content) + len(content) + 1 for content in contents]


@pytest.mark.parametrize("kind", UNCOMPRESSED)
def test_a_bag_cut_off_anywhere_gives_every_message_that_is_whole(tmp_path, read, kind):
    bag = write_sweeps(tmp_path, kind, COUNT)
    data = storage_file(bag).read_bytes()
    ends = ends_of_messages(data)
    cuts = {*range(len(data) - 1, len(data) // 4, -997), *ends, *(end - 1 for end in ends)}
    for cut in sorted(cuts):
        outcome = read(copy_bag(bag, tmp_path / "cut", data[:cut]), "--quiet")
        assert outcome.stamps() == stamps(range(sum(end <= cut for end in ends))), cut
        assert outcome.exit_code == 1
        assert len(outcome.messages) == 1, outcome.messages
    assert max(cuts) == len(data) - 1


@pytest.mark.parametrize("kind", COMPRESSED)
def test_a_compressed_bag_cut_off_anywhere_gives_what_can_be_unpacked(tmp_path, read, kind):
    bag = write_sweeps(tmp_path, kind, COUNT, points=4000)
    data = storage_file(bag).read_bytes()
    seen = set()
    for cut in range(len(data) - 1, 100, -len(data) // 60):
        outcome = read(copy_bag(bag, tmp_path / "cut", data[:cut]), "--quiet")
        assert outcome.stamps() == stamps(range(len(outcome.scans))), cut
        assert outcome.exit_code == 1
        assert outcome.messages
        seen.add(len(outcome.scans))
    assert len(seen) > 1  # the nearer the cut to the end, the more


@needs_recovery
def test_a_sqlite_bag_cut_off_anywhere_gives_every_message_whose_pages_are_there(tmp_path, read):
    bag = write_sweeps(tmp_path, "sqlite", COUNT, points=2000)
    data = storage_file(bag).read_bytes()
    contents = [sweep(number, 2000).tobytes()[-64:] for number in range(COUNT)]
    ends = [data.index(content) + 64 for content in contents]
    page = 4096
    for cut in range(len(data) - page, page, -page):
        outcome = read(copy_bag(bag, tmp_path / "cut", data[:cut]), "--quiet")
        assert outcome.stamps() == stamps(range(len(outcome.scans)))
        # The page that lists a message may stand behind it.
        whole = sum(end <= cut for end in ends)
        assert whole - 2 <= len(outcome.scans) <= whole, cut
        assert outcome.exit_code == 1


@needs_recovery
def test_a_long_sqlite_bag_is_read_though_the_root_of_its_pages_points_behind_the_cut(
    tmp_path, read
):
    count = 1200
    bag = write_sweeps(tmp_path, "sqlite", count, points=150)
    data = storage_file(bag).read_bytes()
    for share in (0.1, 0.4, 0.95):
        outcome = read(copy_bag(bag, tmp_path / "cut", data[: int(len(data) * share)]), "--quiet")
        assert outcome.stamps() == stamps(range(len(outcome.scans)))
        assert len(outcome.scans) == pytest.approx(count * share, abs=0.02 * count)
        assert outcome.exit_code == 1


def test_a_damaged_sqlite_bag_asks_for_the_command_sqlite3_where_it_is_missing(
    tmp_path, read, monkeypatch
):
    bag = write_sweeps(tmp_path, "sqlite", COUNT, points=2000)
    data = bytearray(storage_file(bag).read_bytes())
    page = data.index(sweep(5, 2000).tobytes()[:64]) // 4096 * 4096
    data[page : page + 4096] = bytes(4096)
    monkeypatch.setenv("PATH", "/nowhere")
    outcome = read(copy_bag(bag, tmp_path / "bad", bytes(data)), "--quiet")
    assert outcome.exit_code == 1
    (sentence,) = outcome.messages
    assert "install the command sqlite3" in sentence
    assert outcome.stamps() == []  # counting the messages meets the damage


def test_a_ros_1_bag_that_was_never_closed_is_read_and_says_so(tmp_path, read):
    bag = write_sweeps(tmp_path, "ros1", COUNT)
    data = bag.read_bytes()
    at = data.index(b"index_pos=") + len(b"index_pos=")
    unindexed = data[:at] + bytes(8) + data[at + 8 :]
    outcome = read(copy_bag(bag, tmp_path / "open", unindexed), "--quiet")
    assert outcome.stamps() == stamps(range(COUNT))
    assert outcome.exit_code == 1
    (sentence,) = outcome.messages
    assert "never closed" in sentence


def test_an_mcap_file_without_its_end_is_read_and_says_so(tmp_path, read):
    bag = write_sweeps(tmp_path, "mcap_chunks", COUNT)
    data = storage_file(bag).read_bytes()
    summary_at = struct.unpack_from("<Q", data, len(data) - 28)[0]
    outcome = read(copy_bag(bag, tmp_path / "open", data[:summary_at]), "--quiet")
    assert outcome.stamps() == stamps(range(COUNT))
    assert outcome.exit_code == 1
    (sentence,) = outcome.messages
    assert "never closed" in sentence


def test_a_chunk_with_a_wrong_checksum_is_left_out_alone(tmp_path, read):
    # Each message fills a chunk of its own.
    bag = write_sweeps(tmp_path, "mcap_chunks", 3, points=60000)
    data = bytearray(storage_file(bag).read_bytes())
    # Op, length, three numbers, checksum, length of the name of the compression, name.
    before_checksum = 1 + 8 + 24
    names = [match.start() for match in re.finditer(b"\4\0\0\0zstd", data)]
    chunks = [at - before_checksum - 4 for at in names if data[at - before_checksum - 4] == 6]
    assert len(chunks) == 3
    data[chunks[1] + before_checksum] ^= 1
    outcome = read(copy_bag(bag, tmp_path / "bad", bytes(data)), "--quiet")
    assert outcome.stamps() == stamps([0, 2])
    assert outcome.exit_code == 1
    (sentence,) = outcome.messages
    assert "its checksum is wrong" in sentence and f"byte {chunks[1]}" in sentence


@pytest.mark.parametrize("kind", ["ros1_lz4", "mcap_chunks"])
def test_a_chunk_that_cannot_be_unpacked_is_left_out_alone(tmp_path, read, kind):
    bag = write_sweeps(tmp_path, kind, 3, points=60000)
    data = bytearray(storage_file(bag).read_bytes())
    magic = bytes.fromhex("04224d18" if kind == "ros1_lz4" else "28b52ffd")
    second = data.index(magic, data.index(magic) + 1)
    data[second : second + 4] = b"oops"
    outcome = read(copy_bag(bag, tmp_path / "bad", bytes(data)), "--quiet")
    assert outcome.stamps() == stamps([0, 2])
    assert outcome.exit_code == 1
    (sentence,) = outcome.messages
    assert "chunk at byte" in sentence


def test_a_message_that_contradicts_itself_is_left_out_alone(tmp_path, read):
    make = Messages(False)
    bad = make.cloud(stamp_of(1), sweep(1))
    bad.width += 1000
    clouds = [make.cloud(stamp_of(0), sweep(0)), bad, make.cloud(stamp_of(2), sweep(2))]
    messages = [("/points", stamp_of(k), cloud) for k, cloud in enumerate(clouds)]
    outcome = read(write_bag(tmp_path, "mcap", messages), "--quiet")
    assert outcome.stamps() == stamps([0, 2])
    assert outcome.exit_code == 1
    (sentence,) = outcome.messages
    assert "message 1 of /points" in sentence and "do not fit" in sentence


def test_many_faults_are_counted_and_not_all_told(tmp_path, read):
    make = Messages(False)

    def messages():
        for k in range(20):
            cloud = make.cloud(stamp_of(k), sweep(k))
            cloud.width += 1000 * (k > 0)
            yield "/points", stamp_of(k), cloud

    outcome = read(write_bag(tmp_path, "mcap", messages()), "--quiet")
    assert outcome.stamps() == stamps([0])
    assert len(outcome.messages) == 6
    assert "and 14 more faults" in outcome.messages[-1]


@pytest.mark.parametrize("kind", KINDS)
def test_random_damage_ends_in_sentences_and_whole_scans(tmp_path, read, kind):
    bag = write_sweeps(tmp_path, kind, COUNT)
    data = storage_file(bag).read_bytes()
    chance = random.Random(kind)
    for _ in range(60):
        damaged = bytearray(data)
        for _ in range(chance.randint(1, 4)):
            damaged[chance.randrange(len(damaged))] = chance.randrange(256)
        outcome = read(copy_bag(bag, tmp_path / "bad", bytes(damaged)), "--quiet")
        assert outcome.exit_code == (1 if outcome.messages else 0)
        assert all(message.startswith("lego-loam-sc-read: ") for message in outcome.messages)


@pytest.mark.parametrize("kind", ["ros1", "mcap", "sqlite"])
def test_random_damage_to_the_heads_of_messages_ends_in_sentences(tmp_path, read, kind):
    bag = write_sweeps(tmp_path, kind, COUNT, points=20)
    data = storage_file(bag).read_bytes()
    head = data.index(sweep(3, 20).tobytes()[:12]) - 300
    chance = random.Random(kind)
    for _ in range(150):
        damaged = bytearray(data)
        for _ in range(chance.randint(1, 3)):
            damaged[head + chance.randrange(300)] = chance.randrange(256)
        outcome = read(copy_bag(bag, tmp_path / "bad", bytes(damaged)), "--quiet")
        assert outcome.exit_code == (1 if outcome.messages else 0)
        assert len(outcome.scans) <= COUNT


@pytest.mark.parametrize("promise", [1 << 62, 1 << 29])
def test_a_chunk_that_promises_more_than_memory_holds_is_left_out_alone(tmp_path, read, promise):
    bag = write_sweeps(tmp_path, "mcap_chunks", 3, points=60000)
    data = bytearray(storage_file(bag).read_bytes())
    size_before_name = 8 + 4 + 4  # size, checksum, length of the name of the compression
    second = [match.start() for match in re.finditer(b"zstd", data)][1]
    struct.pack_into("<Q", data, second - size_before_name, promise)
    outcome = read(copy_bag(bag, tmp_path / "bad", bytes(data)), "--quiet")
    assert outcome.stamps() == stamps([0, 2])
    assert outcome.exit_code == 1
    (sentence,) = outcome.messages
    assert f"it promises {promise} bytes" in sentence


def test_a_packed_file_that_unpacks_to_more_than_the_disk_holds_is_cut(tmp_path, read):
    bag = storage_file(write_sweeps(tmp_path, "mcap", 3))
    zeros = zstd.compress(bytes(1 << 26))
    bomb = tmp_path / "bomb.mcap.zstd"
    bomb.write_bytes(zstd.compress(bag.read_bytes() + bytes(1 << 29)))
    outcome = read(bomb, "--quiet")
    assert outcome.exit_code == 1
    assert outcome.stamps() == stamps([0, 1, 2])
    assert "it gives more than 100 times its size" in outcome.messages[0]

    for _ in range(3):  # packed again and again
        zeros = zstd.compress(zeros)
    bomb.write_bytes(zeros)
    outcome = read(bomb, "--quiet")
    assert outcome.exit_code == 1
    (sentence,) = outcome.messages
    assert "bomb.mcap is no ROS bag" in sentence


def test_names_in_metadata_lead_to_no_file_elsewhere(tmp_path, read):
    outside = write_sweeps(tmp_path / "outside", "mcap", COUNT)
    bag = write_sweeps(tmp_path, "mcap", 2)
    metadata = bag / "metadata.yaml"
    path = f"../{outside.relative_to(tmp_path)}/{storage_file(outside).name}"
    text = metadata.read_text().replace(storage_file(bag).name, path)
    metadata.write_text(text + "deep: " + "[" * 100000)
    outcome = read(bag, "--quiet")
    assert outcome.stamps() == stamps(range(2))
