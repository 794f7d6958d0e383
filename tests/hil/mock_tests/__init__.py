"""Tests of the mocks: bytes against bytes put together by hand."""
