"""Only pages of the studio on this machine talk to it."""

import http.client
import re
from importlib.resources import files

import pytest
from served import needs_browser, open_page, served, server

from turgor.studio.guard import access_to

HEADERS = ("content-security-policy", "x-content-type-options", "referrer-policy", "cross-origin-resource-policy")


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    """A server, whose folder has one job."""
    folder = tmp_path_factory.mktemp("guarded")
    (folder / "finger.toml").write_text('[actuator]\ntype = "fast_pneunet"\n', encoding="utf-8")
    with served(folder) as made:
        yield made


def answer_to(studio, path="/api/workspace", method="GET", body=None, **changes):
    """Answer to a request of the page, some of whose headers are changed; None leaves one out."""
    own = {"Host": f"127.0.0.1:{studio.port}", "Origin": studio.origin, "Cookie": studio.cookie()}
    headers = {name: value for name, value in (own | changes).items() if value is not None}
    connection = http.client.HTTPConnection("127.0.0.1", studio.port, timeout=20)
    connection.putrequest(method, path, skip_host=True)
    for name, value in headers.items():
        connection.putheader(name.replace("_", "-"), value)
    if body is not None:
        connection.putheader("Content-Length", str(len(body)))
    connection.endheaders(body)
    answer = connection.getresponse()
    answer.text = answer.read().decode()
    return answer


WRONG = {
    "name that points here": {"Host": "evil.example:8765"},
    "name without the port": {"Host": "127.0.0.1"},
    "other port": {"Host": "127.0.0.1:1"},
    "page of another host": {"Origin": "http://evil.example"},
    "page of another port": {"Origin": "http://127.0.0.1:1"},
    "page without an origin": {"Origin": "null"},
    "no cookie": {"Cookie": None},
    "wrong cookie": {"Cookie": "turgor_studio=guess"},
    "part of another page": {"Origin": None, "Sec_Fetch_Site": "same-site", "Sec_Fetch_Mode": "no-cors"},
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_host_origin_and_token_give_403(studio, case):
    assert answer_to(studio).status == 200
    answer = answer_to(studio, **WRONG[case])
    assert answer.status == 403
    assert "finger" not in answer.text


def test_page_of_other_scheme_gives_403(studio):
    assert answer_to(studio, Origin=f"https://127.0.0.1:{studio.port}").status == 403


def test_wrong_token_in_address_gives_403(studio):
    assert answer_to(studio, "/?token=guess", Cookie=None, Origin=None).status == 403
    answer = answer_to(studio, f"//evil.example/?token={studio.token}", Cookie=None, Origin=None)
    assert answer.status == 303
    assert answer.getheader("location") == "/evil.example/"  # never to another host


def test_edit_without_origin_is_refused(studio):
    body = b'{"values": {"actuator.wall": "2 mm"}, "version": "x"}'
    assert answer_to(studio, "/api/jobs/finger.toml", "PATCH", body, Origin=None).status == 403
    assert answer_to(studio, "/api/jobs/finger.toml", "PATCH", body).status == 409  # let in; the version is an old one


@pytest.mark.parametrize("case", [each for each in WRONG if each != "part of another page"])
@pytest.mark.parametrize("path", ["/ws/events", "/ws/live/finger.reduced"])
def test_wrong_host_origin_and_token_give_403_on_websocket(studio, case, path):
    client = pytest.importorskip("websockets.sync.client")
    from websockets.exceptions import InvalidStatus

    own = {"Host": f"127.0.0.1:{studio.port}", "Origin": studio.origin, "Cookie": studio.cookie()} | WRONG[case]
    host, origin = own.pop("Host"), own.pop("Origin")
    headers = {name: value for name, value in own.items() if value is not None}
    address = f"ws://{host}{path}"
    port = studio.port
    with (
        pytest.raises(InvalidStatus) as refused,
        client.connect(address, origin=origin, additional_headers=headers, sock=_socket(port)),
    ):
        pass
    assert refused.value.response.status_code == 403


def _socket(port):
    import socket

    return socket.create_connection(("127.0.0.1", port), timeout=20)


def test_every_answer_says_what_pages_may_load(studio):
    for path, cookie in (("/", studio.cookie()), ("/api/workspace", studio.cookie()), ("/", None), ("/none", None)):
        answer = answer_to(studio, path, Cookie=cookie)
        assert all(answer.getheader(name) for name in HEADERS), path
        policy = answer.getheader("content-security-policy")
        assert policy.startswith("default-src 'self'")
        assert "unsafe" not in policy


def test_token_is_a_cookie_that_scripts_do_not_see(studio):
    answer = answer_to(studio, f"/?token={studio.token}", Cookie=None, Origin=None)
    assert answer.status == 303
    cookie = answer.getheader("set-cookie").lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    assert studio.token not in answer.getheader("location")


def test_page_has_no_inline_script_or_style():
    page = files("turgor.studio") / "page"
    text = (page / "index.html").read_text("utf-8")
    assert re.findall(r"<script(?![^>]*\bsrc=)", text) == []
    assert re.findall(r"<style|\son\w+=|\sstyle=", text) == []
    assert re.findall(r"https?://", text) == []


def test_path_that_a_page_names_is_not_opened(studio):
    for name in ("..%2F..%2Fetc%2Fpasswd", "%2Fetc%2Fpasswd", "finger.toml%00"):
        answer = answer_to(studio, f"/api/jobs/{name}")
        assert answer.status in (400, 404)
        assert "root:" not in answer.text
    assert answer_to(studio, "/page/../guard.py").status == 404


@needs_browser
def test_page_calls_nobody_else_and_hides_its_token(studio):
    with open_page(studio) as shown:
        assert shown.page.inner_text("h1")
        assert studio.token not in shown.page.url
        assert studio.token not in shown.page.evaluate("document.cookie + JSON.stringify({...localStorage})")
        shown.check()


@needs_browser
def test_killed_server_starts_again_and_the_open_page_goes_on(tmp_path):
    job = tmp_path / "finger.toml"
    job.write_text('[actuator]\ntype = "fast_pneunet"\nwall = "1 mm"\n', encoding="utf-8")
    with served(tmp_path) as first, open_page(first, "#/code/finger.toml") as shown:
        first.kill()
        shown.page.wait_for_selector(".message.wrong")
        job.write_text(job.read_text("utf-8").replace("1 mm", "2 mm"), encoding="utf-8")
        second = server(tmp_path, "--port", str(first.port))
        try:
            assert second.url == first.url
            shown.page.wait_for_selector(".message:has-text('answers again')")
            shown.until("document.querySelector('textarea').value.includes('2 mm')")
            job.write_text(job.read_text("utf-8").replace("2 mm", "3 mm"), encoding="utf-8")
            shown.until("document.querySelector('textarea').value.includes('3 mm')")
        finally:
            second.kill()


def test_second_server_of_a_folder_names_the_first(tmp_path):
    with served(tmp_path) as first:
        second = server(tmp_path, "--port", "0")
        assert second.process.wait(20) == 0
        assert second.url == first.url


def test_address_that_other_machines_reach_warns(tmp_path):
    with served(tmp_path, "--host", "0.0.0.0", "--allow-host", "lab.example") as studio:
        warning = studio.process.stdout.readline()
        assert warning.startswith("Warning: bound to 0.0.0.0")
        assert "--allow-host" in warning
        assert studio.origin == f"http://127.0.0.1:{studio.port}"  # an address that a browser opens
        named = {"Host": f"lab.example:{studio.port}", "Origin": f"http://lab.example:{studio.port}"}
        assert answer_to(studio, **named).status == 200
        assert answer_to(studio, Host=f"0.0.0.0:{studio.port}").status == 403


def test_name_with_a_port_of_its_own_is_that_of_a_tunnel():
    hosts = access_to("127.0.0.1", 8765, "s", ["localhost:9000", "lab"]).hosts
    assert {"localhost:9000", "lab:8765"} <= hosts
    assert "lab" not in hosts
