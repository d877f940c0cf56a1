"""Only pages of the studio on this machine talk to it."""

from served import needs_browser, open_page, served


@needs_browser
def test_page_of_empty_folder_calls_nobody_else(tmp_path):
    with served(tmp_path) as studio, open_page(studio) as shown:
        assert shown.page.inner_text("h1")
        assert studio.token not in shown.page.url
        shown.check()
