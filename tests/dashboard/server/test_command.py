"""Where the dashboard listens, to whom it opens, and what it refuses before it says that it serves."""

import argparse
import socket

import pytest

from dashboard.cli import main
from dashboard.server import command


@pytest.fixture
def taken():
    """Return a port that somebody listens at."""
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        yield other.getsockname()[1]


def test_a_port_in_use_is_said_and_nothing_is_announced(taken, capsys):
    assert main(["serve", "--port", str(taken)]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err == (
        f"trackig: port {taken} is in use: stop what is served there, or give another with --port\n"
    )


@pytest.mark.parametrize(
    ("address", "words"),
    [("203.0.113.7", "this machine has no such address"), ("no..name", "this machine knows no such address")],
)
def test_an_address_of_another_machine_is_refused(address, words, capsys):
    assert main(["serve", "--port", "1", "--address", address]) == 2
    assert words in capsys.readouterr().err


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "write one line"),
        (b"\n", "write one line"),
        (b"one\ntwo\n", "write one line"),
        (b"x" * 2000, "at most 1024 bytes"),
        (b"\xff\xfe", "this is no text"),
    ],
)
def test_a_file_without_a_password_is_refused(data, words, tmp_path, capsys):
    path = tmp_path / "password.txt"
    path.write_bytes(data)
    assert main(["serve", "--password-file", str(path)]) == 2
    error = capsys.readouterr().err
    assert str(path) in error
    assert words in error


def test_a_password_file_that_is_not_there_is_said(tmp_path, capsys):
    assert main(["serve", "--password-file", str(tmp_path / "none.txt")]) == 2
    assert "No such file" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["--processes", "0"], ["--processes", "many"], ["--most-sessions", "-1"]])
def test_numbers_below_one_are_refused(words, capsys):
    with pytest.raises(SystemExit):
        main(["serve", *words])
    assert "give a whole number of one or more" in capsys.readouterr().err


def test_nobody_else_is_told_an_address_unless_it_is_asked_for():
    assert command.reachable_hosts("127.0.0.1") == ("localhost",)
    assert command.reachable_hosts("::1") == ("localhost",)
    assert command.reachable_hosts("192.0.2.9") == ("192.0.2.9",)
    assert command.reachable_hosts("2001:db8::9") == ("[2001:db8::9]",)
    assert command.reachable_hosts("trackig.example") == ("trackig.example",)


def test_all_addresses_are_told_by_names_that_others_can_type():
    hosts = command.reachable_hosts("0.0.0.0")
    assert socket.gethostname() in hosts
    assert not {"0.0.0.0", "127.0.0.1", "localhost"} & set(hosts)


def served(monkeypatch, words):
    """Return the site that ``trackig serve`` would serve."""
    found = {}
    monkeypatch.setattr(
        "dashboard.server.processes.run",
        lambda site, listeners, processes, announce: found.update(
            site=site, processes=processes, announce=announce, closed=[each.close() for each in listeners]
        ),
    )
    parser = argparse.ArgumentParser()
    command.add_arguments(parser, int, int)
    command.serve(parser.parse_args(words))
    return found


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ([], "at http://localhost:{port}/dashboard, to this machine only (--address 0.0.0.0 opens"),
        (["--prefix", "tools/ig/"], "at http://localhost:{port}/tools/ig/dashboard, to this machine only"),
        (["--address", "0.0.0.0"], ":{port}/dashboard, to the network, without a password;"),
        (["--address", "0.0.0.0", "--password-file", "{file}"], "to the network, behind a password;"),
    ],
)
def test_the_first_line_says_where_and_to_whom(words, told, monkeypatch, tmp_path, capsys):
    file = tmp_path / "password.txt"
    file.write_text("squeeze\n")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    found = served(monkeypatch, ["--port", str(port), *(each.format(file=file) for each in words)])
    assert capsys.readouterr().out == ""
    found["announce"]()
    assert told.format(port=port) in capsys.readouterr().out
    assert found["site"].password == ("squeeze" if file.name in str(words) or "{file}" in words else None)


def test_hosts_of_proxies_are_taken_with_or_without_what_stands_around_them(monkeypatch):
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    words = ["--allow-origin", "https://Trackig.example/", "--allow-origin", "other.example:8443"]
    site = served(monkeypatch, ["--port", str(port), *words])["site"]
    assert site.origins == (
        f"localhost:{port}",
        f"127.0.0.1:{port}",
        "trackig.example",
        "other.example:8443",
    )
