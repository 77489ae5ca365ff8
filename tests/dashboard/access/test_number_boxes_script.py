"""The script for number boxes reaches the page, compressed or not."""

import gzip
import http.client

import pytest


@pytest.mark.parametrize("encoding", ["identity", "gzip"])
def test_the_page_has_the_script_before_its_body(dashboard, encoding):
    connection = http.client.HTTPConnection("127.0.0.1", dashboard.server.get_port())
    connection.request("GET", "/", headers={"Accept-Encoding": encoding})
    response = connection.getresponse()
    body = response.read()
    assert response.headers["Content-Length"] == str(len(body))
    page = gzip.decompress(body) if response.headers["Content-Encoding"] == "gzip" else body
    head, _, _ = page.partition(b"<body>")
    assert head.count(b"mantine-NumberInput-input") == 1
