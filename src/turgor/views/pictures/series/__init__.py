"""Series of pictures: sheets of several states or designs, and motion as GIF, WebP, MP4 and GLB."""
