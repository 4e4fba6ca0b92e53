$ Nastran file written by meshio v5.0.0
BEGIN BULK
GRID*   1                                          0.E+0           0.E+0
*                  1.E+0
GRID*   2                                          0.E+0           0.E+0
*                  0.E+0
GRID*   3                                          0.E+0           1.E+0
*                  1.E+0
GRID*   4                                          0.E+0           1.E+0
*                  0.E+0
GRID*   5                                          1.E+0           0.E+0
*                  0.E+0
GRID*   6                                          1.E+0           0.E+0
*                  1.E+0
GRID*   7                                          1.E+0           1.E+0
*                  1.E+0
GRID*   8                                          1.E+0           1.E+0
*                  0.E+0
GRID*   9                                         1.7E+0           0.E+0
*                  1.E+0
GRID*   10                                        1.7E+0           0.E+0
*                  0.E+0
GRID*   11                                        1.7E+0           1.E+0
*                  1.E+0
GRID*   12                                        1.7E+0           1.E+0
*                  0.E+0
GRID*   13                                         0.E+0           5.E-1
*                  5.E-1
GRID*   14                                         1.E+0           5.E-1
*                  5.E-1
GRID*   15                                         5.E-1           0.E+0
*                  5.E-1
GRID*   16                                         5.E-1           1.E+0
*                  5.E-1
GRID*   17                                         5.E-1           5.E-1
*                  0.E+0
GRID*   18                                         5.E-1           5.E-1
*                  1.E+0
GRID*   19                                        1.7E+0           5.E-1
*                  5.E-1
GRID*   20                                       1.35E+0           0.E+0
*                  5.E-1
GRID*   21                                       1.35E+0           1.E+0
*                  5.E-1
GRID*   22                                       1.35E+0           5.E-1
*                  0.E+0
GRID*   23                                       1.35E+0           5.E-1
*                  1.E+0
CTRIA3* 1                               2               1               *11     
*11     13              
CTRIA3* 2                               1               3               *12     
*12     13              
CTRIA3* 3                               4               2               *13     
*13     13              
CTRIA3* 4                               3               4               *14     
*14     13              
CTETRA* 5                               16              13              *15     
*15     17              14              
CTETRA* 6                               13              16              *16     
*16     18              14              
CTETRA* 7                               15              17              *17     
*17     13              14              
CTETRA* 8                               18              15              *18     
*18     13              14              
CTETRA* 9                               2               17              *19     
*19     4               13              
CTETRA* 10                              1               13              *1a     
*1a     3               18              
CTETRA* 11                              4               13              *1b     
*1b     16              3               
CTETRA* 12                              1               2               *1c     
*1c     13              15              
CTETRA* 13                              8               7               *1d     
*1d     16              14              
CTETRA* 14                              1               15              *1e     
*1e     18              6               
CTETRA* 15                              6               7               *1f     
*1f     14              18              
CTETRA* 16                              16              3               *110    
*110    18              7               
CTETRA* 17                              17              4               *111    
*111    16              8               
CTETRA* 18                              2               17              *112    
*112    15              5               
CTETRA* 19                              5               6               *113    
*113    14              15              
CTETRA* 20                              5               8               *114    
*114    17              14              
CTETRA* 21                              17              4               *115    
*115    13              16              
CTETRA* 22                              13              16              *116    
*116    3               18              
CTETRA* 23                              2               17              *117    
*117    13              15              
CTETRA* 24                              15              13              *118    
*118    1               18              
CTETRA* 25                              18              16              *119    
*119    7               14              
CTETRA* 26                              15              18              *11a    
*11a    6               14              
CTETRA* 27                              14              15              *11b    
*11b    17              5               
CTETRA* 28                              17              16              *11c    
*11c    14              8               
CTETRA* 29                              11              21              *11d    
*11d    12              19              
CTETRA* 30                              9               23              *11e    
*11e    11              19              
CTETRA* 31                              19              22              *11f    
*11f    12              10              
CTETRA* 32                              19              9               *120    
*120    20              10              
CTETRA* 33                              7               6               *121    
*121    14              23              
CTETRA* 34                              8               7               *122    
*122    14              21              
CTETRA* 35                              6               5               *123    
*123    14              20              
CTETRA* 36                              5               8               *124    
*124    14              22              
CTETRA* 37                              14              21              *125    
*125    23              19              
CTETRA* 38                              23              20              *126    
*126    14              19              
CTETRA* 39                              22              14              *127    
*127    20              19              
CTETRA* 40                              21              14              *128    
*128    22              19              
CTETRA* 41                              23              7               *129    
*129    21              14              
CTETRA* 42                              23              20              *12a    
*12a    6               14              
CTETRA* 43                              8               21              *12b    
*12b    14              22              
CTETRA* 44                              20              14              *12c    
*12c    22              5               
CTETRA* 45                              21              11              *12d    
*12d    23              19              
CTETRA* 46                              23              9               *12e    
*12e    20              19              
CTETRA* 47                              22              12              *12f    
*12f    21              19              
CTETRA* 48                              19              20              *130    
*130    22              10              
CTETRA* 49                              8               12              *131    
*131    21              22              
CTETRA* 50                              5               22              *132    
*132    20              10              
CTETRA* 51                              9               20              *133    
*133    6               23              
CTETRA* 52                              23              7               *134    
*134    11              21              
ENDDATA
