/* Reads grey pictures: PGM files (P5) of 8 bits a pixel. The examples share it. */
#ifndef PGM_HPP
#define PGM_HPP

#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

struct Pgm {
    std::size_t width = 0, height = 0;
    std::vector<unsigned char> pixels;

    explicit Pgm(const std::string &name)
    {
        std::ifstream file(name, std::ios::binary);
        std::string magic;
        std::size_t white = 0;
        file >> magic >> width >> height >> white;
        file.get();
        if (!file || magic != "P5" || white != 255 || width == 0 || width > 100000 || height == 0 ||
            height > 100000)
            throw std::runtime_error(name + " is no PGM file (P5) of 8 bits a pixel");
        pixels.resize(width * height);
        if (!file.read(reinterpret_cast<char *>(pixels.data()),
                       static_cast<std::streamsize>(pixels.size())))
            throw std::runtime_error(name + " is too short");
    }
};

#endif
